#include "cpu_reference/raster/bresenham.h"

#include "gpu/raster/bresenham.h"
#include "tests/raster/lines.h"
#include "tests/stage.h"

namespace parity {
namespace {

using raster_test::Lines;

const Registration registration = register_stage<std::vector<Segment>, Lines>({
    .name = "raster/bresenham",
    .title = "The pixels of a segment, in integers",
    .source = "notes 1.9; Bresenham 1965",
    .rows = {22},
    .axes = raster_test::line_axes(),
    .problem = raster_test::random_segments,
    .cpu = {{.solve = [](const std::vector<Segment>& s) { return cpu::bresenham(s); }}},
    .gpu = {{.solve = [](gpu::Context& context,
                         const std::vector<Segment>& s) { return gpu::bresenham(context, s); }}},
    .distance = [](const Lines& got, const Lines& want) { return got == want ? 0.0 : 1.0; },
    .tolerance = 0.0,
    .why = "integers on both sides",
    .error =
        [](const std::vector<Segment>& segments, const Lines& lines) {
          double worst = 0;  // distance from the ideal line along the minor axis
          for (std::size_t i = 0; i < lines.size(); ++i) {
            const dvec2 d{segments[i].end - segments[i].begin};
            const bool steep = std::abs(d.y) > std::abs(d.x);
            for (const ivec2& pixel : lines[i]) {
              const dvec2 p{pixel - segments[i].begin};
              if (d == dvec2(0)) continue;
              worst = std::max(
                  worst, steep ? std::abs(p.x - p.y * d.x / d.y) : std::abs(p.y - p.x * d.y / d.x));
            }
          }
          return worst;
        },
    .error_unit = "px",
    .chart_axes = {"reach"},
});

}  // namespace
}  // namespace parity
