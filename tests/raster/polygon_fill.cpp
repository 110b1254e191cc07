#include "cpu_reference/raster/polygon_fill.h"

#include "geometry/random.h"
#include "gpu/raster/polygon_fill.h"
#include "tests/stage.h"

namespace parity {
namespace {

struct Fill {
  Polygon polygon;
  FillRule rule = FillRule::even_odd;
  int side = 0;
};
auto fields_of(const Fill*) { return std::tuple{&Fill::polygon, &Fill::rule, &Fill::side}; }

/// Rings of random points on 1/256 pixels, so that every decision is one of integers; some edges
/// are horizontal and some corners stand on pixel centres.
Fill random_rings(const Setting& setting) {
  Random random{setting.seed};
  Fill fill;
  fill.rule = FillRule(setting.count("rule"));
  fill.side = setting.count("side");
  const auto steps = std::uint32_t(fill.side) * 256;
  for (int r = 0; r < 3; ++r) {
    std::vector<vec2> ring;
    for (int i = 0; i < setting.count("corners"); ++i) {
      vec2 p{float(random.below(steps)) / 256.0f, float(random.below(steps)) / 256.0f};
      if (i % 3 == 1) p.y = ring.back().y;
      if (i % 4 == 3) p = glm::floor(p) + 0.5f;
      ring.push_back(p);
    }
    fill.polygon.rings.push_back(ring);
  }
  return fill;
}

const Registration registration = register_stage<Fill, Grid<std::uint8_t>>({
    .name = "raster/polygon_fill",
    .title = "The inside of crossing rings, even-odd or non-zero",
    .source = "notes 1.9",
    .rows = {23},
    .axes = {{.name = "corners", .low = 0, .high = 100, .standard = 12, .whole = true},
             {.name = "rule", .low = 0, .high = 1, .standard = 0, .whole = true},
             {.name = "side",
              .unit = "px",
              .low = 1,
              .high = 257,
              .standard = 64,
              .logarithmic = true,
              .whole = true}},
    .problem = random_rings,
    .cpu = {{.solve =
                 [](const Fill& f) {
                   return cpu::polygon_fill(f.polygon, f.rule, f.side, f.side);
                 }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const Fill& f) {
                   return gpu::polygon_fill(context, f.polygon, f.rule, f.side, f.side);
                 }}},
    .distance =
        [](const Grid<std::uint8_t>& got, const Grid<std::uint8_t>& want) {
          double wrong = 0;
          for (std::size_t i = 0; i < want.size(); ++i)
            wrong += got.values()[i] != want.values()[i];
          return wrong;
        },
    .tolerance = 0.0,
    .why = "pixels that differ: corners are multiples of 2^-8 px, so both sides decide exactly",
    .chart_axes = {"side"},
});

}  // namespace
}  // namespace parity
