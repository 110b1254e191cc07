#include "gpu/shading/shadow_map.h"

#include <gtest/gtest.h>

#include "cpu_reference/shading/shadow_map.h"
#include "geometry/random.h"
#include "tests/chart.h"
#include "tests/stage.h"

namespace parity {

auto fields_of(const ShadowProblem*) {
  return std::tuple{&ShadowProblem::points, &ShadowProblem::shadow_from_world,
                    &ShadowProblem::depths, &ShadowProblem::ends,
                    &ShadowProblem::radius, &ShadowProblem::bias};
}

namespace {

/// Blocks at random depths under a light that looks down -z; cascades of 1, 2, 4 and 8 m.
ShadowProblem blocks(const Setting& setting) {
  Random random{setting.seed};
  ShadowProblem p;
  const int side = setting.count("side");
  p.radius = setting.count("radius");
  p.bias = 0.001f;
  for (std::size_t k = 0; k < 4; ++k) {
    const float size = float(1 << k);
    p.ends[int(k)] = size;
    p.shadow_from_world[k] = mat4(vec4(1 / size, 0.1f, 0.05f, 0), vec4(-0.1f, 1 / size, 0, 0),
                                  vec4(0, 0, -0.1f, 0), vec4(0.5f, 0.5f, 0.5f, 1));
    p.depths[k] = Grid<float>{side, side};
    for (float& depth : p.depths[k]) depth = random.uniform();
  }
  for (int i = 0; i < setting.count("count"); ++i)
    p.points.emplace_back(random.in_box(2.0f), random.uniform(0, 9));
  return p;
}

const Registration registration = register_stage<ShadowProblem, std::vector<double>>({
    .name = "shading/shadow_map",
    .title = "Shadow maps in four cascades, with percentage-closer filtering",
    .source = "notes 6.1; Williams 1978; Reeves et al. 1987; Zhang et al. 2006",
    .axes = {{.name = "count",
              .low = 1,
              .high = 4099,
              .standard = 1031,
              .logarithmic = true,
              .whole = true},
             {.name = "side", .unit = "px", .low = 1, .high = 131, .standard = 32, .whole = true},
             {.name = "radius", .unit = "px", .low = 0, .high = 8, .standard = 1, .whole = true}},
    .problem = blocks,
    .cpu = {{.solve = [](const ShadowProblem& p) { return cpu::shadow_map(p); }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const ShadowProblem& p) {
                   const std::vector<float> values = gpu::shadow_map(context, p);
                   return std::vector<double>(values.begin(), values.end());
                 }}},
    .distance =
        [](const std::vector<double>& got, const std::vector<double>& want) {
          double worst = 0;
          for (std::size_t i = 0; i < want.size(); ++i)
            worst = std::max(worst, std::abs(got[i] - want[i]));
          return worst;
        },
    .tolerance =
        [](const ShadowProblem& p) {
          return 0x1p-24 * (4 + (2.0 * p.radius + 2) * (2.0 * p.radius + 2));
        },
    .why = "which texels hide is decided alike; (2 r + 2)^2 weights up to 1 are added, over (2 r + "
           "1)^2",
});

/// One map, all points in the first cascade.
ShadowProblem one_map(Grid<float> depths, int radius, float bias) {
  ShadowProblem p;
  p.shadow_from_world.fill(mat4(1.0f));
  p.depths.fill(depths);
  p.ends = vec4(1);
  p.radius = radius;
  p.bias = bias;
  return p;
}

TEST(ShadowMap, APenumbraIsARampAsWideAsTheFilter) {
  // Texels left of the middle hide everything behind depth 0.5.
  Grid<float> depths{16, 16, 1.0f};
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 8; ++x) depths(x, y) = 0.5f;
  for (const int radius : {0, 1, 2}) {
    ShadowProblem p = one_map(depths, radius, 0);
    for (int i = 0; i <= 64; ++i) p.points.emplace_back(float(i) / 64, 0.5f, 0.75f, 0.0f);
    const std::vector<double> seen = cpu::shadow_map(p);
    for (int i = 12; i <= 52; ++i) {
      const double texels = (i / 64.0 - 0.5) * 16, width = 2 * radius + 1;
      EXPECT_NEAR(seen[std::size_t(i)], std::clamp(texels / width + 0.5, 0.0, 1.0), 1e-12);
    }
  }
}

TEST(ShadowMap, NothingHidesBeyondTheCascadesOrTheMap) {
  ShadowProblem p = one_map(Grid<float>{4, 4, 0.0f}, 0, 0);
  p.points = {vec4(0.5f, 0.5f, 0.5f, 2), vec4(-3, 0.5f, 0.5f, 0), vec4(0.5f, 0.5f, 0.5f, 0)};
  const std::vector<double> seen = cpu::shadow_map(p);
  EXPECT_EQ(seen, (std::vector<double>{1, 1, 0}));
}

TEST(ShadowMap, CascadesEndAtTheFarPlaneAndGrow) {
  for (const double logarithmic : {0.0, 0.5, 1.0}) {
    const std::vector<double> ends = cascade_ends(0.1, 100, 4, logarithmic);
    EXPECT_NEAR(ends.back(), 100, 1e-9);
    for (std::size_t i = 1; i < 4; ++i) EXPECT_GT(ends[i], ends[i - 1]);
  }
  EXPECT_NEAR(cascade_ends(1, 16, 4, 1)[1], 4, 1e-12);
}

/// Share of the light that a lit plane of this slope (depth over a texel) loses to its own map.
double acne(double slope, double bias, int radius) {
  constexpr int side = 64;
  Grid<float> depths{side, side};
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) depths(x, y) = float((x + 0.5) * slope / side);
  ShadowProblem p = one_map(depths, radius, float(bias / side));
  Random random{1};
  for (int i = 0; i < 400; ++i) {
    const float x = random.uniform(0.25f, 0.75f);
    p.points.emplace_back(x, 0.5f, x * float(slope), 0.0f);
  }
  double lost = 0;
  for (const double seen : cpu::shadow_map(p)) lost += 1 - seen;
  return lost / double(p.points.size());
}

const Registration map = register_map({
    .name = "shading/shadow_acne",
    .title = "Light that a sloped plane loses to its own shadow map, filter 3 texels wide",
    .x = {.name = "slope",
          .unit = "depth/texel",
          .low = 0.1,
          .high = 10,
          .standard = 1,
          .logarithmic = true},
    .y = {.name = "bias",
          .unit = "depth",
          .low = 0.1,
          .high = 30,
          .standard = 1,
          .logarithmic = true},
    .value_label = "light lost",
    .logarithmic = false,
    .border = 1e-3,
    .columns = 20,
    .rows = 16,
    .value = [](gpu::Context&, double slope, double bias) { return acne(slope, bias, 1); },
    .theory = {{"bias = slope (radius + 1)", [](double slope) { return 2 * slope; }}},
});

}  // namespace
}  // namespace parity
