#include "cpu_reference/raster/viewport.h"

#include <gtest/gtest.h>

#include "geometry/random.h"
#include "gpu/raster/viewport.h"
#include "tests/stage.h"

namespace parity {
namespace {

struct Positions {
  std::vector<vec4> clip;
  int width = 0;
  int height = 0;
};
auto fields_of(const Positions*) {
  return std::tuple{&Positions::clip, &Positions::width, &Positions::height};
}

Positions random_positions(const Setting& setting) {
  Random random{setting.seed};
  Positions p{{}, setting.count("side"), setting.count("side") / 2 + 1};
  for (int i = 0; i < setting.count("count"); ++i) {
    const float w = std::exp2(random.uniform(-10, 10));
    p.clip.push_back(vec4(random.in_box(1.5f) * w, w));
  }
  return p;
}

/// In units of what each component is made of: W, H, 1 and 1/w.
double distance(const Positions& p, const std::vector<dvec4>& got, const std::vector<dvec4>& want) {
  double worst = 0;
  for (std::size_t i = 0; i < want.size(); ++i) {
    const dvec4 scale{p.width, p.height, 1.5, want[i].w};
    const dvec4 apart = glm::abs(got[i] - want[i]) / scale;
    worst = std::max({worst, apart.x, apart.y, apart.z, apart.w});
  }
  return worst;
}

const Registration registration = register_stage<Positions, std::vector<dvec4>>({
    .name = "raster/viewport",
    .title = "Window position of a clip position",
    .source = "notes 1.2; Vulkan 1.3, Controlling the Viewport",
    .rows = {3, 36},
    .axes = {{.name = "count",
              .low = 1,
              .high = 4099,
              .standard = 131,
              .logarithmic = true,
              .whole = true},
             {.name = "side",
              .unit = "px",
              .low = 1,
              .high = 16384,
              .standard = 1080,
              .logarithmic = true,
              .whole = true}},
    .problem = random_positions,
    .cpu = {{.solve =
                 [](const Positions& p) { return cpu::to_window(p.clip, p.width, p.height); }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const Positions& p) {
                   const std::vector<vec4> window =
                       gpu::to_window(context, p.clip, p.width, p.height);
                   return std::vector<dvec4>(window.begin(), window.end());
                 }}},
    .distance = distance,
    .tolerance = 10 * 0x1p-24,
    .why = "1/w by a division of 2.5 ULP (5 u), times x (1 u), times W/2 and plus W/2 (2 u each), "
           "for |x/w| <= 1.5",
    .chart_axes = {"count"},
});

TEST(Viewport, MinusOneIsTheTopLeftCorner) {
  const std::vector<vec4> corners{{-2, -2, 1, 2}, {2, 2, 1, 2}};
  const auto window = cpu::to_window(corners, 640, 480);
  EXPECT_EQ(dvec2(window[0]), dvec2(0, 0));
  EXPECT_EQ(dvec2(window[1]), dvec2(640, 480));
  EXPECT_EQ(window[0].z, 0.5);
  EXPECT_EQ(window[0].w, 0.5);
}

}  // namespace
}  // namespace parity
