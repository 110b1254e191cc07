#include "gpu/shading/prefilter.h"

#include <gtest/gtest.h>

#include <numbers>

#include "cpu_reference/shading/lookup.h"
#include "cpu_reference/shading/prefilter.h"
#include "tests/shading/environments.h"
#include "tests/stage.h"

namespace parity {
namespace {

using namespace shading_test;
using std::numbers::pi;

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
