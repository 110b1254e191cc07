#include <gtest/gtest.h>

#include <numbers>

#include "cpu_reference/shading/lookup.h"
#include "cpu_reference/shading/prefilter.h"
#include "gpu/shading/prefilter.h"
#include "tests/chart.h"
#include "tests/shading/environments.h"
#include "tests/stage.h"

namespace parity {
namespace {

using namespace shading_test;
using std::numbers::pi;

struct IrradianceProblem {
  int source_side = 64;
  std::uint64_t seed = 1;
};
auto fields_of(const IrradianceProblem*) {
  return std::tuple{&IrradianceProblem::source_side, &IrradianceProblem::seed};
}

EnvironmentMap map_of(const IrradianceProblem& p) { return lamps(p.seed, p.source_side, 4); }

IrradianceProblem of_a_power_of_two(const Setting& s) {
  return {1 << int(std::lround(std::log2(s.at("source_side")))), s.seed};
}

Axis source_axis(double largest) {
  return {.name = "source_side",
          .unit = "px",
          .low = 8,
          .high = largest,
          .standard = 64,
          .each = false};
}

/// Root mean square between the middles of texels, against the sum over the finest level.
double irradiance_error(const IrradianceProblem& p, const Grid<vec4>& irradiance) {
  const Grid<vec4> fine = map_of(p).levels[0];
  const EnvironmentLight light{{}, with_border(irradiance)};
  Random random{11};
  double sum = 0;
  constexpr int count = 24;
  for (int i = 0; i < count; ++i) {
    const dvec3 n{random.direction()};
    dvec3 exact{0.0};
    for (int y = 0; y < fine.height(); ++y)
      for (int x = 0; x < fine.width(); ++x) {
        const dvec3 d = octahedral_direction((dvec2(x, y) + 0.5) / double(fine.width()));
        const double length = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
        exact += dvec3(fine(x, y)) * (std::max(glm::dot(d, n), 0.0) * std::pow(length, 3));
      }
    exact *= 4 / (pi * double(fine.size()));
    const auto got = cpu::irradiance_over_pi<double>(light, {n.x, n.y, n.z});
    sum += std::pow(glm::length(dvec3(got.x, got.y, got.z) - exact) / glm::length(exact), 2);
  }
  return std::sqrt(sum / count);
}

const Registration irradiance = register_stage<IrradianceProblem, Grid<vec4>>({
    .name = "shading/irradiance",
    .title = "Irradiance of an environment by normal, summed over its texels",
    .source = "notes 6.1, 8.1",
    .axes = {source_axis(256)},
    .problem = of_a_power_of_two,
    .cpu = {{.solve =
                 [](const IrradianceProblem& p) { return cpu::prefilter_irradiance(map_of(p)); }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const IrradianceProblem& p) {
                   return gpu::prefilter_irradiance(context, map_of(p));
                 }}},
    .distance = [](const Grid<vec4>& got,
                   const Grid<vec4>& want) { return largest_apart(got, want); },
    .tolerance =
        [](const IrradianceProblem& p) {
          const int side = std::min(p.source_side, irradiance_source_side);
          return 0x1p-24 * (4 * side + 96) * extremes(map_of(p).levels[0]).x;
        },
    .why = "light and weights are sums of as many sums as there are rows of as many numbers as a "
           "row has: 2 side u each; 40 u for a weight, whose cosine is off by 4 u of all light, 16 "
           "u of the mean",
    .error = irradiance_error,
    .error_unit = "1",
    .chart_axes = {"source_side"},
});

using Coefficients = std::array<vec3, 9>;

const Registration harmonics_stage = register_stage<IrradianceProblem, Coefficients>({
    .name = "shading/irradiance_harmonics",
    .title = "Irradiance of an environment by normal, as nine polynomials",
    .source = "Ramamoorthi & Hanrahan 2001",
    .axes = {source_axis(128)},
    .problem = of_a_power_of_two,
    .cpu = {{.solve =
                 [](const IrradianceProblem& p) { return cpu::project_irradiance(map_of(p)); }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const IrradianceProblem& p) {
                   return gpu::project_irradiance(context, map_of(p));
                 }}},
    .distance =
        [](const Coefficients& got, const Coefficients& want) {
          double worst = 0;
          for (std::size_t k = 0; k < 9; ++k)
            worst = std::max(worst, double(glm::length(got[k] - want[k])));
          return worst;
        },
    .tolerance =
        [](const IrradianceProblem& p) {
          const double largest = extremes(map_of(p).levels[0]).x;
          return 0x1p-24 * (2 * 64 + 40) * 4 * largest;
        },
    .why = "two sums of 64 numbers and 40 u for each of them, of light times a polynomial and its "
           "factor, which integrate to at most 4 times the largest light",
});

/// A lamp of that radius at the top, as bright as it takes to give irradiance pi.
EnvironmentMap lamp(double degrees) {
  Grid<vec4> picture{256, 128, vec4(0, 0, 0, 1)};
  const double edge = std::cos(degrees * pi / 180);
  for (int y = 0; y < 128; ++y) {
    const double top = std::cos(pi * y / 128), bottom = std::cos(pi * (y + 1) / 128);
    const double part = std::clamp((top - edge) / (top - bottom), 0.0, 1.0);
    for (int x = 0; x < 256; ++x) picture(x, y) = vec4(vec3(float(part / (1 - edge * edge))), 1);
  }
  return environment_map(picture, 128);
}

/// Irradiance over pi of such a lamp, by the angle to the normal: the lamp in 256 rings.
double under_lamp(double degrees, double angle) {
  double sum = 0;
  for (int k = 0; k < 256; ++k) {
    const double z =
        std::cos(degrees * pi / 180) + (1 - std::cos(degrees * pi / 180)) * (k + 0.5) / 256;
    for (int i = 0; i < 64; ++i)
      sum += std::max(0.0, z * std::cos(angle) + std::sqrt(1 - z * z) * std::sin(angle) *
                                                     std::cos(2 * pi * (i + 0.5) / 64));
  }
  return sum / (256 * 64) * 2 / (1 + std::cos(degrees * pi / 180));
}

double by_harmonics(const std::array<vec3, 9>& coefficients, const dvec3& n) {
  const EnvironmentLight light{{}, {}, coefficients};
  return cpu::irradiance_over_pi<double>(light, {n.x, n.y, n.z}).x;
}

ChartData irradiance_models(gpu::Context&) {
  Series map{"map of 64 x 64 normals", {}}, harmonics{"nine harmonics", {}};
  for (const double degrees : {4.0, 8.0, 16.0, 30.0, 45.0, 60.0, 75.0, 90.0}) {
    const EnvironmentMap light = lamp(degrees);
    const EnvironmentLight by_map{{}, with_border(cpu::prefilter_irradiance(light))};
    const std::array<vec3, 9> coefficients = cpu::project_irradiance(light);
    double worst_map = 0, worst_harmonics = 0;
    for (int k = 0; k <= 36; ++k) {
      const double angle = pi * k / 36, want = under_lamp(degrees, angle);
      const dvec3 n{0.6 * std::sin(angle), std::cos(angle), 0.8 * std::sin(angle)};
      const double got = cpu::irradiance_over_pi<double>(by_map, {n.x, n.y, n.z}).x;
      worst_map = std::max(worst_map, std::abs(got - want));
      worst_harmonics = std::max(worst_harmonics, std::abs(by_harmonics(coefficients, n) - want));
    }
    map.points.push_back({degrees, worst_map});
    harmonics.points.push_back({degrees, worst_harmonics});
  }
  ChartData data;
  data.series = {map, harmonics};
  data.assertions = {
      {"worst error of the map", std::ranges::max(map.points, {}, &Point::y).y, 0.02}};
  return data;
}

const Registration models_chart = register_chart({
    .name = "shading/irradiance_models",
    .title = "Irradiance of a lamp by a map of normals and by nine harmonics: worst error",
    .x = {.label = "radius of the lamp", .unit = "degrees"},
    .y = {.label = "error, over the irradiance straight on"},
    .produce = irradiance_models,
});

TEST(Environment, AUniformOneStaysUniform) {
  const EnvironmentMap map = environment_map(Grid<vec4>{32, 16, vec4(0.25f, 0.5f, 2, 1)}, 64);
  const EnvironmentLight light = cpu::prefilter(map, 4);
  const vec3 want{0.25f, 0.5f, 2};
  EXPECT_TRUE(light.irradiance.empty());
  for (const vec4& texel : cpu::prefilter_irradiance(map))
    EXPECT_LT(glm::length(vec3(texel) - want), 1e-5f);
  for (const dvec3& n : {dvec3(0, 1, 0), dvec3(0.6, 0, -0.8), dvec3(-0.36, -0.48, 0.8)})
    EXPECT_NEAR(by_harmonics(light.harmonics, n), want.x, 1e-3);  // by quadrature on 64 x 64 texels
  for (const Grid<vec4>& level : light.mirrors)
    for (const vec4& texel : level) EXPECT_LT(glm::length(vec3(texel) - want), 1e-5f);
}

double irradiance_at(const EnvironmentMap& map, const dvec3& n) {
  const EnvironmentLight light{{}, with_border(cpu::prefilter_irradiance(map))};
  return cpu::irradiance_over_pi<double>(light, {n.x, n.y, n.z}).x;
}

TEST(Environment, HarmonicsHoldLightOfDegreeOneExactly) {
  // L = 1 + y: the irradiance over pi is 1 + 2/3 n.y.
  Grid<vec4> picture{128, 64};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 128; ++x)
      picture(x, y) = vec4(vec3(float(1 + std::cos(pi * (y + 0.5) / 64))), 1);
  const std::array<vec3, 9> k = cpu::project_irradiance(environment_map(picture, 64));
  EXPECT_NEAR(k[0].x, 1, 1e-3);  // texels of 3 degrees
  EXPECT_NEAR(k[1].x, 2.0 / 3, 2e-3);
  EXPECT_NEAR(k[2].x, 0, 1e-3);
  EXPECT_NEAR(k[8].x, 0, 1e-3);
}

TEST(Environment, IrradianceOfLightOfDegreeOneIsTwoThirdsAsSteep) {
  // L = 1 + y: the irradiance over pi is 1 + 2/3 n.y. The octahedron bends at its edges: half a
  // texel of a slope of 2/3 sqrt(3/8).
  Grid<vec4> picture{128, 64};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 128; ++x)
      picture(x, y) = vec4(vec3(float(1 + std::cos(pi * (y + 0.5) / 64))), 1);
  const EnvironmentMap map = environment_map(picture, 64);
  for (const dvec3& n : {dvec3(0, 1, 0), dvec3(0, -1, 0), dvec3(0.6, 0, 0.8), dvec3(0, 0.6, -0.8)})
    EXPECT_NEAR(irradiance_at(map, n), 1 + 2.0 / 3 * n.y, 8e-3);
}

TEST(Environment, HarmonicsSufficeWhereTheyAreWithinAHundredthOfTheMean) {
  // A lamp of 90 degrees is half the sky: the harmonics of its irradiance, (1 + cos) / 2, are exact
  // but for those of odd degree from 3, which the cosine lobe has none of.
  for (const double degrees : {4.0, 45.0, 90.0}) {
    const EnvironmentLight light = cpu::prefilter(lamp(degrees), 4);
    EXPECT_EQ(light.irradiance.empty(), degrees == 90) << degrees;
  }
  std::array<vec3, 9> harmonics{vec3(1)};
  Grid<vec4> map{16, 16, vec4(1)};
  EXPECT_TRUE(harmonics_suffice(harmonics, map));
  map(3, 5).y = 1.02f;
  EXPECT_FALSE(harmonics_suffice(harmonics, map));
}

TEST(Environment, IrradianceOfALampFollowsTheCosine) {
  // A lamp of 3 degrees at the top: 2 % of its light for its size and the texels. The nine
  // harmonics that stand for irradiance elsewhere miss by 6 %, and shine from below.
  Grid<vec4> picture{256, 128, vec4(0, 0, 0, 1)};
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 256; ++x) picture(x, y) = vec4(1000);
  const EnvironmentMap map = environment_map(picture, 256);
  const double straight = irradiance_at(map, {0, 1, 0});
  const std::array<vec3, 9> coefficients = cpu::project_irradiance(map);
  double harmonics = 0;
  for (const double degrees : {30.0, 60.0, 80.0, 95.0, 120.0, 180.0}) {
    const double a = degrees * pi / 180, want = std::max(std::cos(a), 0.0);
    const dvec3 n{0.6 * std::sin(a), std::cos(a), 0.8 * std::sin(a)};
    EXPECT_NEAR(irradiance_at(map, n) / straight, want, 0.02) << degrees;
    harmonics = std::max(harmonics, std::abs(by_harmonics(coefficients, n) / straight - want));
  }
  EXPECT_GT(harmonics, 0.05);
}

}  // namespace
}  // namespace parity
