#include "cpu_reference/raster/dda_line.h"

#include <limits>

#include "gpu/raster/dda_line.h"
#include "tests/raster/lines.h"
#include "tests/stage.h"

namespace parity {
namespace {

using raster_test::Lines;

const Registration registration = register_stage<std::vector<Segment>, Lines>({
    .name = "raster/dda_line",
    .title = "The pixels of a segment, by adding floats and rounding",
    .source = "notes 1.9",
    .rows = {24},
    .axes = raster_test::line_axes(),
    .problem = raster_test::random_segments,
    .cpu = {{.solve = [](const std::vector<Segment>& s) { return cpu::dda_line(s); }}},
    .gpu = {{.solve = [](gpu::Context& context,
                         const std::vector<Segment>& s) { return gpu::dda_line(context, s); }}},
    .distance =
        [](const std::vector<Segment>& segments, const Lines& got, const Lines& want) {
          double worst =
              0;  // where they differ: how far the ideal line is from halfway between two pixels
          for (std::size_t i = 0; i < want.size(); ++i) {
            if (got[i].size() != want[i].size()) return std::numeric_limits<double>::infinity();
            for (std::size_t k = 0; k < want[i].size(); ++k) {
              if (got[i][k] == want[i][k]) continue;
              const dvec2 step =
                  dvec2(segments[i].end - segments[i].begin) / double(want[i].size() - 1);
              const dvec2 ideal = dvec2(segments[i].begin) + double(k) * step;
              const dvec2 from_half = glm::abs(glm::fract(ideal) - 0.5);
              const ivec2 apart = glm::abs(got[i][k] - want[i][k]);
              if (apart.x > 1 || apart.y > 1) return std::numeric_limits<double>::infinity();
              worst = std::max(worst,
                               std::max(apart.x ? from_half.x : 0.0, apart.y ? from_half.y : 0.0));
            }
          }
          return worst;
        },
    .tolerance =
        [](const std::vector<Segment>& segments) {
          double worst = 0;
          for (const Segment& s : segments) {
            const ivec2 d = glm::abs(s.end - s.begin);
            const ivec2 b = glm::abs(s.begin);
            const double n = std::max(d.x, d.y);
            worst = std::max(worst, 2 * n * 0x1p-24 * (std::max(b.x, b.y) + n));
          }
          return worst;
        },
    .why = "n additions, each rounded at the size of the coordinate, and a step that is itself "
           "rounded: a drift of "
           "n 2^-24 (|begin| + n) px on either side decides otherwise only that near to halfway",
    .chart_axes = {"reach"},
});

}  // namespace
}  // namespace parity
