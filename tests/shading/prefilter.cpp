#include "gpu/shading/prefilter.h"

#include <gtest/gtest.h>

#include <numbers>

#include "cpu_reference/shading/lookup.h"
#include "cpu_reference/shading/prefilter.h"
#include "geometry/random.h"
#include "tests/chart.h"
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

/// Root mean square between the middles of texels, against the sum over the finest level.
double irradiance_error(const MirrorProblem& p, const Grid<vec4>& irradiance) {
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

const Registration irradiance = register_stage<MirrorProblem, Grid<vec4>>({
    .name = "shading/irradiance",
    .title = "Irradiance of an environment by normal, summed over its texels",
    .source = "notes 6.1, 8.1",
    .axes = {{.name = "source_side",
              .unit = "px",
              .low = 8,
              .high = 256,
              .standard = 64,
              .each = false}},
    .problem =
        [](const Setting& s) {
          const int power = int(std::lround(std::log2(s.at("source_side"))));
          return MirrorProblem{16, 1 << power, 1, 0.5f, s.seed};
        },
    .cpu = {{.solve = [](const MirrorProblem& p) { return cpu::prefilter_irradiance(map_of(p)); }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const MirrorProblem& p) {
                   return gpu::prefilter_irradiance(context, map_of(p));
                 }}},
    .distance = [](const Grid<vec4>& got,
                   const Grid<vec4>& want) { return largest_apart(got, want); },
    .tolerance =
        [](const MirrorProblem& p) {
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

const Registration harmonics_stage = register_stage<MirrorProblem, Coefficients>({
    .name = "shading/irradiance_harmonics",
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

TEST(Environment, LampsOfAPixelKeepTheirLight) {
  // Each lamp of one pixel is spread over texels: their light times their solid angle is the
  // lamp's.
  Grid<vec4> picture{512, 256, vec4(0, 0, 0, 1)};
  std::vector<dvec3> lamps;
  std::vector<double> lights;
  for (int k = 0; k < 48; ++k) {
    const int x = (k * 211) % 512, y = 40 + (k * 37) % 176;  // far apart, and not at a pole
    const double theta = pi * (y + 0.5) / 256, phi = 2 * pi * ((x + 0.5) / 512 - 0.5);
    picture(x, y) = vec4(1000);
    lamps.emplace_back(std::sin(theta) * std::sin(phi), std::cos(theta),
                       -std::sin(theta) * std::cos(phi));
    lights.push_back(1000 * std::sin(theta) * (pi / 256) * (2 * pi / 512));
  }
  const Grid<vec4> level = environment_map(picture, 128).levels[0];
  std::vector<double> sums(lamps.size());
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x) {
      const dvec3 d = octahedral_direction((dvec2(x, y) + 0.5) / 128.0);
      const double length = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
      for (std::size_t k = 0; k < lamps.size(); ++k)
        if (glm::dot(d, lamps[k]) > std::cos(0.08))
          sums[k] += double(level(x, y).x) * 4 * std::pow(length, 3) / (128.0 * 128.0);
    }
  for (std::size_t k = 0; k < lamps.size(); ++k)
    EXPECT_NEAR(sums[k] / lights[k], 1, 0.15) << k;  // two samples a pixel and axis, not more
}

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

TEST(Environment, SmoothMirrorsHaveNoHaze) {
  // What a lamp of 1.4 degrees leaves at an angle from it is D / 4 of the half vector times its
  // light.
  Grid<vec4> picture{256, 128, vec4(0, 0, 0, 1)};
  for (int x = 0; x < 256; ++x) picture(x, 0) = vec4(1);
  const double light = 2 * pi * (1 - std::cos(pi / 128));
  const EnvironmentLight mirrors = cpu::prefilter(environment_map(picture, 256), 64);
  const auto shown = [&](double degrees, double roughness) {
    const double a = degrees * pi / 180;
    return cpu::mirrored<double>(mirrors, {0.6 * std::sin(a), std::cos(a), 0.8 * std::sin(a)},
                                 roughness)
        .x;
  };
  const auto exact = [&](double degrees, double alpha) {
    const double t = std::pow(std::tan(degrees * pi / 360), 2) + alpha * alpha;
    return light * alpha * alpha / (4 * pi * t * t);
  };
  for (const double degrees : {4.0, 8.0, 16.0}) {
    EXPECT_LT(shown(degrees, 0.045), 2 * exact(degrees, 0.045 * 0.045)) << degrees;
    // Few samples stand for the tail, which their texels widen: up to twice as much. A mixture with
    // roughness 0.2 would have five times as much at 0.1.
    EXPECT_LT(shown(degrees, 0.1), 2.5 * exact(degrees, 0.01)) << degrees;
    EXPECT_GT(shown(degrees, 0.1), 0.7 * exact(degrees, 0.01)) << degrees;
    EXPECT_LT(shown(degrees, 0.2), 2 * exact(degrees, 0.04)) << degrees;
  }
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
