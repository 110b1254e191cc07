#include "cpu_reference/raster/wide_line.h"

#include "geometry/random.h"
#include "gpu/raster/wide_line.h"
#include "tests/stage.h"

namespace parity {
namespace {

struct WideLine {
  vec2 begin{0.0f};
  vec2 end{0.0f};
  float line_width = 1;
  int side = 0;
  int subpixel_bits = 8;
};
auto fields_of(const WideLine*) {
  return std::tuple{&WideLine::begin, &WideLine::end, &WideLine::line_width, &WideLine::side,
                    &WideLine::subpixel_bits};
}

WideLine random_line(const Setting& setting, const gpu::DeviceInfo& device) {
  Random random{setting.seed * 977 + std::uint64_t(setting.count("line"))};
  WideLine line;
  line.side = setting.count("side");
  const float high = float(line.side) - 1;
  line.begin = {random.uniform(1, high), random.uniform(1, high)};
  line.end = {random.uniform(1, high), random.uniform(1, high)};
  line.line_width = float(setting.at("width"));
  if (device.subpixel_bits > 0) line.subpixel_bits = device.subpixel_bits;
  return line;
}

/// The farthest from the border of the rectangle that a pixel is decided otherwise, px.
double distance(const WideLine& line, const Grid<std::uint8_t>& got,
                const Grid<std::uint8_t>& want) {
  double worst = 0;
  for (int y = 0; y < line.side; ++y)
    for (int x = 0; x < line.side; ++x)
      if (got(x, y) != want(x, y))
        worst = std::max(worst, cpu::wide_line_border_distance(
                                    line.begin, line.end, line.line_width, {x + 0.5, y + 0.5}));
  return worst;
}

const Registration
    registration =
        register_stage<WideLine, Grid<std::uint8_t>>(
            {
                .name = "raster/wide_line",
                .title = "A segment with a width, as a rectangle",
                .source = "notes 1.9; Vulkan 1.3, Basic Line Segment Rasterization",
                .rows = {22, 24},
                .axes = {{.name = "line", .low = 1, .high = 40, .standard = 7, .whole = true},
                         {.name = "width", .unit = "px", .low = 1, .high = 9, .standard = 1},
                         {.name = "side",
                          .unit = "px",
                          .low = 5,
                          .high = 257,
                          .standard = 64,
                          .logarithmic = true,
                          .whole = true}},
                .problem = random_line,
                .cpu = {{.solve =
                             [](const WideLine& l) {
                               return cpu::wide_line(l.begin, l.end, l.line_width, l.side, l.side);
                             }}},
                .gpu = {{.name = "compute",
                         .solve =
                             [](gpu::Context& context, const WideLine& l) {
                               return gpu::wide_line(context, l.begin, l.end, l.line_width,
                                                     ivec2(l.side));
                             }},
                        {.name = "hardware",
                         .solve = [](gpu::Context& context,
                                     const WideLine& l) -> Measured<Grid<std::uint8_t>> {
                           if (l.line_width != 1)
                             throw Unsupported("hardware lines are drawn 1 px wide");
                           return gpu::hardware_line(context, l.begin, l.end, gpu::LineRule::any,
                                                     ivec2(l.side));
                         }}},
                .distance = distance,
                .tolerance =
                    [](const WideLine& l) {
                      return std::sqrt(2.0) * std::exp2(-l.subpixel_bits) + 4 * 0x1p-23 * l.side;
                    },
                .why = "px from the border at which the two may decide differently: a vertex moves "
                       "by at most a step of the "
                       "sub-pixel grid in each direction; float rounding of a window coordinate",
            });

}  // namespace
}  // namespace parity
