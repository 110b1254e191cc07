#include "gpu/shading/tone_map.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "cpu_reference/shading/tone_map.h"
#include "geometry/random.h"
#include "tests/chart.h"
#include "tests/compare.h"
#include "tests/stage.h"

namespace parity {
namespace {

struct ToneProblem {
  Grid<vec4> colors;
  ToneMap tone_map = ToneMap::neutral;
  float exposure = 0;
};
auto fields_of(const ToneProblem*) {
  return std::tuple{&ToneProblem::colors, &ToneProblem::tone_map, &ToneProblem::exposure};
}

ToneProblem random_colors(const Setting& setting) {
  Random random{setting.seed};
  ToneProblem p{Grid<vec4>{setting.count("side"), 17}, ToneMap(setting.count("operator")),
                float(setting.at("exposure"))};
  for (vec4& c : p.colors) {
    const float strength = std::exp2(random.uniform(-8, 8));
    c = vec4(random.uniform(-0.1f, 1), random.uniform(), random.uniform(), 1) * strength;
  }
  return p;
}

const Registration registration = register_stage<ToneProblem, Grid<vec4>>({
    .name = "shading/tone_map",
    .title = "Light of any strength on a screen: Khronos PBR Neutral, ACES, AgX",
    .source = "Khronos PBR Neutral Tone Mapper 2024; Hill 2016; Sobotka 2022; Wrensch 2023",
    .axes = {{.name = "side", .unit = "px", .low = 1, .high = 257, .standard = 131, .whole = true},
             {.name = "operator", .low = 0, .high = 3, .standard = 1, .whole = true, .each = true},
             {.name = "exposure", .unit = "stops", .low = -8, .high = 8, .standard = 0}},
    .problem = random_colors,
    .cpu = {{.solve =
                 [](const ToneProblem& p) {
                   return cpu::tone_map(p.colors, p.tone_map, p.exposure);
                 }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const ToneProblem& p) {
                   return gpu::tone_map(context, p.colors, p.tone_map, p.exposure);
                 }}},
    .distance =
        [](const ToneProblem& p, const Grid<vec4>& got, const Grid<vec4>& want) {
          double worst = 0;
          for (std::size_t i = 0; i < want.size(); ++i)
            for (int c = 0; c < 4; ++c)
              worst = std::max(worst, double(std::abs(got.values()[i][c] - want.values()[i][c])));
          return p.tone_map == ToneMap::agx ? worst / 16 : worst;
        },
    .tolerance = 96 * 0x1p-24,
    .why =
        "results are up to 1.6 before they are clamped, from quotients (2.5 ULP), two 3 x 3 "
        "products "
        "and sums, 96 u; AgX 16 times that: its polynomial adds terms up to 40 with 12 roundings, "
        "the matrix after it 1.3, and x^2.2 is 2.2 times as steep",
});

TEST(ToneMap, NeutralKeepsBaseColoursUnderGreyLight) {
  // What a dielectric reflects at normal incidence is 0.04 more than its base colour.
  for (const dvec3 base : {dvec3(0.5, 0.2, 0.1), dvec3(0.7, 0.7, 0.05)}) {
    const dvec3 shown = cpu::tone_map(base + 0.04, ToneMap::neutral);
    EXPECT_LT(glm::length(shown - base), base.z < 0.06 ? 2e-3 : 1e-12);
  }
}

TEST(ToneMap, IsMonotoneAndEndsAtWhite) {
  for (const ToneMap map : {ToneMap::clamp, ToneMap::neutral, ToneMap::aces, ToneMap::agx}) {
    double last = -1;
    for (double light = 1e-4; light < 1e5; light *= 1.3) {
      const dvec3 shown = cpu::tone_map(dvec3(light), map);
      EXPECT_GE(shown.x, last - 1e-12) << int(map) << " at " << light;
      EXPECT_NEAR(shown.x, shown.y,
                  map == ToneMap::clamp || map == ToneMap::neutral ? 1e-15 : 0.02);
      last = shown.x;
    }
    EXPECT_GT(last, 0.97) << int(map);
    EXPECT_LE(last, 1);
    const dvec3 nothing = cpu::tone_map(dvec3(std::nan(""), -1, 0), map);
    EXPECT_TRUE(nothing.x >= 0 && nothing.x < 0.01);
  }
}

ChartData curves(gpu::Context& context) {
  ChartData data;
  const std::array<const char*, 4> names{"clamp", "Khronos PBR Neutral", "ACES", "AgX"};
  Grid<vec4> ramp{61, 1};
  for (int i = 0; i < 61; ++i) ramp(i, 0) = vec4(vec3(std::exp2(float(i) / 6 - 6)), 1);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const Grid<vec4> shown = gpu::tone_map(context, ramp, ToneMap(k), 0);
    Series series{names[k], {}};
    for (int i = 0; i < 61; ++i)
      series.points.push_back({double(ramp(i, 0).x), std::max(1e-5, double(shown(i, 0).x))});
    data.series.push_back(series);
  }
  return data;
}

const Registration chart = register_chart({
    .name = "shading/tone_curves",
    .title = "What grey light becomes on the screen",
    .x = {.label = "light"},
    .y = {.label = "shown (linear)"},
    .produce = curves,
});

}  // namespace
}  // namespace parity
