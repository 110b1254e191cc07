#include "gpu/shading/prefilter.h"

#include <gtest/gtest.h>

#include <numbers>

#include "cpu_reference/shading/lookup.h"
#include "cpu_reference/shading/prefilter.h"
#include "geometry/random.h"
#include "tests/stage.h"

namespace parity {
namespace {

using std::numbers::pi;

/// A sky with some lamps: lobes of light over a gradient.
EnvironmentMap lamps(std::uint64_t seed, int side, float strength) {
  Random random{seed};
  Grid<vec4> picture{128, 64};
  std::array<vec3, 5> directions;
  for (vec3& d : directions) d = random.direction();
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 128; ++x) {
      const double theta = pi * (y + 0.5) / 64, phi = 2 * pi * ((x + 0.5) / 128 - 0.5);
      const vec3 d{dvec3(std::sin(theta) * std::sin(phi), std::cos(theta),
                         -std::sin(theta) * std::cos(phi))};
      vec3 light{0.5f + 0.4f * d.y, 0.5f, 0.6f - 0.3f * d.x};
      for (const vec3& lamp : directions)
        light += strength * std::pow(std::max(0.0f, glm::dot(d, lamp)), 40.0f);
      picture(x, y) = vec4(light, 1);
    }
  return environment_map(picture, side);
}

struct MirrorProblem {
  int side = 16;
  int source_side = 64;
  int samples = 64;
  float roughness = 0.5f;
  std::uint64_t seed = 1;
};
auto fields_of(const MirrorProblem*) {
  return std::tuple{&MirrorProblem::side, &MirrorProblem::source_side, &MirrorProblem::samples,
                    &MirrorProblem::roughness, &MirrorProblem::seed};
}

EnvironmentMap map_of(const MirrorProblem& p) { return lamps(p.seed, p.source_side, 4); }

/// Largest radiance and largest change from texel to texel.
dvec2 extremes(const Grid<vec4>& level) {
  dvec2 result{0.0};
  for (int y = 0; y < level.height(); ++y)
    for (int x = 0; x < level.width(); ++x)
      for (int c = 0; c < 3; ++c) {
        result.x = std::max(result.x, double(level(x, y)[c]));
        if (x + 1 < level.width())
          result.y = std::max(result.y, double(std::abs(level(x + 1, y)[c] - level(x, y)[c])));
      }
  return result;
}

double largest_apart(const Grid<vec4>& got, const Grid<vec4>& want) {
  double worst = 0;
  for (std::size_t i = 0; i < want.size(); ++i)
    for (int c = 0; c < 3; ++c)
      worst = std::max(worst, double(std::abs(got.values()[i][c] - want.values()[i][c])));
  return worst;
}

/// Root mean square over some texels, against the sum over all light.
double error(const MirrorProblem& p, const Grid<vec4>& mirror) {
  const EnvironmentMap map = map_of(p);
  double sum = 0;
  int count = 0;
  for (int y = 1; y < p.side; y += 5)
    for (int x = 1; x < p.side; x += 5, ++count) {
      const dvec3 n = octahedral_direction((dvec2(x, y) + 0.5) / double(p.side));
      const dvec3 exact = p.roughness > 0 ? cpu::mirror_by_quadrature(map.levels[0], p.roughness, n)
                                          : dvec3(radiance_toward(map, n));
      sum += std::pow(glm::length(dvec3(mirror(x, y)) - exact) / glm::length(exact), 2);
    }
  return std::sqrt(sum / count);
}

const Registration registration = register_stage<MirrorProblem, Grid<vec4>>({
    .name = "shading/prefilter",
    .title = "What a rough mirror shows of an environment, by importance sampling",
    .source = "notes 6.2, 8.2; Karis 2013; Colbert & Krivanek 2007",
    .axes = {{.name = "samples",
              .low = 1,
              .high = 1024,
              .standard = 64,
              .logarithmic = true,
              .whole = true},
             {.name = "roughness", .low = 0, .high = 1, .standard = 0.5},
             {.name = "side", .unit = "px", .low = 8, .high = 33, .standard = 16, .whole = true}},
    .problem =
        [](const Setting& s) {
          return MirrorProblem{s.count("side"), 64, s.count("samples"), float(s.at("roughness")),
                               s.seed};
        },
    .cpu = {{.solve =
                 [](const MirrorProblem& p) {
                   return cpu::prefilter_mirror(map_of(p), p.roughness, p.side, p.samples);
                 }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const MirrorProblem& p) {
                   return gpu::prefilter_mirror(context, map_of(p), p.roughness, p.side, p.samples);
                 }}},
    .distance = [](const Grid<vec4>& got,
                   const Grid<vec4>& want) { return largest_apart(got, want); },
    .tolerance =
        [](const MirrorProblem& p) {
          const dvec2 most = extremes(map_of(p).levels[0]);
          return 0x1p-24 * (256 * most.x + 64.0 * p.source_side * most.y) + 0x1p-20 * most.x;
        },
    .why =
        "directions are off by 32 u, places by 64 u of the map's side, which changes light by the "
        "largest step from texel to texel; weights and mixtures 256 u of the largest light; the "
        "level by Vulkan's log2, 2^-21, between levels that differ by at most that light",
    .error = error,
    .error_unit = "1",
    .chart_axes = {"samples"},
});

using Coefficients = std::array<vec3, 9>;

const Registration irradiance = register_stage<MirrorProblem, Coefficients>({
    .name = "shading/irradiance",
    .title = "Irradiance of an environment by normal, as nine polynomials",
    .source = "Ramamoorthi & Hanrahan 2001",
    .axes = {{.name = "source_side",
              .unit = "px",
              .low = 8,
              .high = 128,
              .standard = 64,
              .each = false}},
    .problem =
        [](const Setting& s) {
          const int power = int(std::lround(std::log2(s.at("source_side"))));
          return MirrorProblem{16, 1 << power, 1, 0.5f, s.seed};
        },
    .cpu = {{.solve = [](const MirrorProblem& p) { return cpu::project_irradiance(map_of(p)); }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const MirrorProblem& p) {
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
        [](const MirrorProblem& p) {
          const double largest = extremes(map_of(p).levels[0]).x;
          return 0x1p-24 * (2 * 64 + 40) * 4 * largest;
        },
    .why = "two sums of 64 numbers and 40 u for each of them, of light times a polynomial and its "
           "factor, which integrate to at most 4 times the largest light",
});

TEST(Environment, OctahedralMapsGoThereAndBack) {
  Random random{5};
  for (int i = 0; i < 200; ++i) {
    const dvec3 d = glm::normalize(dvec3(random.direction()));
    EXPECT_LT(glm::length(octahedral_direction(octahedral_uv(d)) - d), 1e-12);
  }
  EXPECT_EQ(octahedral_uv({0, 0, 1}), dvec2(0.5, 0.5));
}

TEST(Environment, LooksTheWayItsPictureDoes) {
  Grid<vec4> picture{64, 32, vec4(0, 0, 0, 1)};
  for (int x = 0; x < 64; ++x) picture(x, 0) = vec4(1, 0, 0, 1);                     // top
  for (int y = 12; y < 20; ++y) picture(32, y) = picture(31, y) = vec4(0, 1, 0, 1);  // middle
  const EnvironmentMap map = environment_map(picture, 64);
  EXPECT_GT(radiance_toward(map, {0, 1, 0}).x, 0.8f);
  EXPECT_GT(radiance_toward(map, {0, 0, -1}).y, 0.8f);
  EXPECT_LT(radiance_toward(map, {0, 0, 1}).y, 0.01f);
  EXPECT_LT(radiance_toward(map, {0, -1, 0}).x, 0.01f);
}

TEST(Environment, AUniformOneStaysUniform) {
  const EnvironmentMap map = environment_map(Grid<vec4>{32, 16, vec4(0.25f, 0.5f, 2, 1)}, 64);
  const EnvironmentLight light = cpu::prefilter(map, 4);
  const vec3 want{0.25f, 0.5f, 2};
  EXPECT_LT(glm::length(light.irradiance[0] - want), 1e-5f);
  for (std::size_t k = 1; k < 9; ++k) EXPECT_LT(glm::length(light.irradiance[k]), 1e-3f);
  for (const Grid<vec4>& level : light.mirrors)
    for (const vec4& texel : level) EXPECT_LT(glm::length(vec3(texel) - want), 1e-5f);
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

TEST(Environment, LookupsInIntervalsHoldWhatIsAround) {
  const EnvironmentLight light = cpu::prefilter(lamps(3, 64, 20), 8);
  Random random{8};
  for (int i = 0; i < 200; ++i) {
    const dvec3 d{random.direction()};
    const double e = std::exp2(random.uniform(-20, -6)), roughness = random.uniform();
    using cpu::Interval;
    const auto around = [&](double v) { return Interval(v - e, v + e); };
    const cpu::Triple<Interval> box =
        cpu::mirrored<Interval>(light, {around(d.x), around(d.y), around(d.z)}, around(roughness));
    const dvec3 moved = d + e * dvec3(random.in_box(1));
    const cpu::Triple<double> value = cpu::mirrored<double>(light, {moved.x, moved.y, moved.z},
                                                            roughness + e * random.uniform(-1, 1));
    EXPECT_TRUE(box.x.low <= value.x && value.x <= box.x.high) << e << " at " << d.x << " " << d.y;
    EXPECT_TRUE(box.z.low <= value.z && value.z <= box.z.high) << e;
  }
}

}  // namespace
}  // namespace parity
