// What is put on surfaces other than by a lookup: noise, projections, bent normals, displacement.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "cpu_reference/texture/environment.h"
#include "cpu_reference/texture/procedural.h"
#include "cpu_reference/texture/projection.h"
#include "cpu_reference/texture/surface_detail.h"
#include "gpu/texture/displacement.h"
#include "tests/gpu_context.h"
#include "tests/texture/textures.h"

namespace parity {
namespace {

TEST(PerlinNoise, IsThePublishedFunction) {
  EXPECT_NEAR(cpu::procedural(Procedural::perlin, {3.14, 42, 7}), 0.13691995878400012, 1e-15);
  for (const dvec3 p : {dvec3(0, 0, 0), dvec3(-3, 200, 17), dvec3(5, -6, 300)})
    EXPECT_EQ(cpu::procedural(Procedural::perlin, p), 0);
}

/// At whole points every octave is 0, at halves all but the first are, at quarters all but two.
TEST(Fractals, EndWhereTheirOctavesMeetTheLattice) {
  for (const dvec3 whole : {dvec3(0), dvec3(-3, 200, 17), dvec3(5, -6, 1)}) {
    EXPECT_EQ(cpu::procedural(Procedural::fractal, whole), 0);
    EXPECT_EQ(cpu::procedural(Procedural::turbulence, whole), 0);
    EXPECT_NEAR(cpu::procedural(Procedural::marble, whole), 0.5, 1e-13);
    const auto noise = [](dvec3 p) { return cpu::procedural(Procedural::perlin, p); };
    for (const dvec3 part : {dvec3(0.5), dvec3(0.5, 0, 0.5), dvec3(0.25, 0.5, 0.75)}) {
      const dvec3 p = whole + part;
      EXPECT_NEAR(cpu::procedural(Procedural::fractal, p), noise(p) + noise(2.0 * p) / 2, 1e-15);
      EXPECT_NEAR(cpu::procedural(Procedural::turbulence, p),
                  std::abs(noise(p)) + std::abs(noise(2.0 * p)) / 2, 1e-15);
    }
  }
  EXPECT_NEAR(cpu::procedural(Procedural::wood, {0, 4, 1}), 0, 1e-13);
  EXPECT_NEAR(cpu::procedural(Procedural::wood, {3, 4, 0}), 0, 1e-13);
}

/// Octaves are as good as independent: their variances add up, 1 + 1/4 + 1/16 ..
TEST(Fractals, HaveTheVarianceOfTheirOctaves) {
  Random random{12};
  double noise = 0, fractal = 0;
  for (int i = 0; i < 20000; ++i) {
    const dvec3 p{random.uniform(0, 256), random.uniform(0, 256), random.uniform(0, 256)};
    noise += std::pow(cpu::procedural(Procedural::perlin, p), 2);
    const double sum = cpu::procedural(Procedural::fractal, p);
    fractal += sum * sum;
    EXPECT_GE(cpu::procedural(Procedural::turbulence, p), std::abs(sum));
  }
  const double want = (1 - std::pow(0.25, procedural_octaves)) / (1 - 0.25);
  // A ratio of two sums of 20000 squares of about normal numbers: 5 times sqrt(2 / 20000 2).
  EXPECT_NEAR(fractal / noise, want, 5 * std::sqrt(4.0 / 20000) * want);
}

TEST(Projection, PlanarAndCylindricalHaveTheirClosedForms) {
  const auto uv = [](Projection kind, dvec3 p) { return cpu::project(kind, p).uv; };
  const auto expect = [&](Projection kind, dvec3 p, dvec2 want) {
    EXPECT_LT(glm::distance(uv(kind, p), want), 1e-15) << p.x << " " << p.y << " " << p.z;
  };
  // The square from -1 to 1, v down; depth does not count.
  expect(Projection::planar, {-1, 1, 5}, {0, 0});
  expect(Projection::planar, {1, -1, -3}, {1, 1});
  expect(Projection::planar, {0.5, 0.25, 0}, {0.75, 0.375});
  // Around the y axis from +z over -x, -z (the middle) and +x; the distance does not count.
  expect(Projection::cylindrical, {0, 0, -1}, {0.5, 0.5});
  expect(Projection::cylindrical, {3, 1, 0}, {0.75, 0});
  expect(Projection::cylindrical, {-0.2, -1, 0}, {0.25, 1});
  expect(Projection::cylindrical, {2, 0.5, -2}, {0.625, 0.25});
  expect(Projection::cylindrical, {2, 0.5, 2}, {0.875, 0.25});
  expect(Projection::cylindrical, {-2, 0.5, 2}, {0.125, 0.25});
}

TEST(Projection, RoundTripsDirections) {
  Random random{2};
  for (int i = 0; i < 200; ++i) {
    const dvec3 d = glm::normalize(dvec3(random.direction()));
    for (const Projection kind : {Projection::spherical, Projection::cubic}) {
      const cpu::TexturePoint place = cpu::project(kind, d * 3.0);
      EXPECT_LT(glm::distance(cpu::direction_of(kind, place), d), 1e-14);
      EXPECT_TRUE(place.uv.x >= 0 && place.uv.x <= 1 && place.uv.y >= 0 && place.uv.y <= 1);
    }
  }
  EXPECT_LT(glm::distance(cpu::project(Projection::spherical, {0, 0, -1}).uv, dvec2(0.5)), 1e-15);
  EXPECT_EQ(cpu::project(Projection::cubic, {0, 1, 0}).face, 2);
  EXPECT_LT(glm::distance(cpu::triplanar_weights({0, 2, 0}), dvec3(0, 1, 0)), 1e-15);
}

TEST(Environment, HasNoSeams) {
  Random random{4};
  Grid<vec4> faces{8, 48}, picture{16, 8};
  for (vec4& t : faces) t = vec4(random.uniform());
  for (vec4& t : picture) t = vec4(random.uniform());
  const double step = 1e-9;  // of a slope of up to 16 texels a unit
  for (int i = 0; i < 400; ++i) {
    dvec3 d = glm::normalize(dvec3(random.direction()));
    if (i % 2 == 0) d.x = -d.z;  // on a cube's edge
    if (i % 2 == 1) d.x = 0;     // on the meridian where the picture's sides meet, or over a pole
    if (i % 4 == 3) d = {0, d.y > 0 ? 1 : -1, 0};
    const dvec3 aside{step, 0, step / 2};
    const auto across = [&](const auto& of, const auto& texels) {
      return std::abs(of(texels, d + aside).x - of(texels, d - aside).x);
    };
    EXPECT_LT(across(cpu::sample_cube_map, faces), 100 * step) << i;
    EXPECT_LT(across(cpu::sample_equirectangular, picture), 1e4 * step) << i;
  }
}

TEST(SurfaceDetail, FlatMapsChangeNothingAndSlopesTilt) {
  SurfaceDetail d{};
  d.normal = {0, 0, 2};
  d.tangent = {3, 0, 0, -1};
  d.p_u = {2, 0, 0};
  d.p_v = {1, 1, 0};
  d.texel = {0.5f, 0.5f, 1};
  d.scale = 1;
  EXPECT_LT(glm::distance(cpu::bump(d), dvec3(0, 0, 1)), 1e-15);
  EXPECT_LT(glm::distance(cpu::normal_map(d), dvec3(0, 0, 1)), 1e-15);
  d.slope = {2, 1};  // h = x
  EXPECT_LT(glm::distance(cpu::bump(d), glm::normalize(dvec3(-1, 0, 1))), 1e-15);
  d.texel = {0.5f, 1, 0.5f};  // along the bitangent, which the handedness turns
  EXPECT_LT(glm::distance(cpu::normal_map(d), dvec3(0, -1, 0)), 1e-15);
}

TEST(Parallax, MeetsAFlatFieldWhereGeometrySays) {
  const Grid<u8vec4> field{4, 4, u8vec4(51)};  // depth 0.8
  const cpu::ParallaxHit hit = cpu::parallax(field, {0.3, 0.4}, {0.6, 0, 0.8}, 0.1, 16);
  const double step = 1 / 16.0 / 256;
  EXPECT_NEAR(hit.depth, 0.8, step);
  EXPECT_NEAR(hit.uv.x, 0.3 - 0.8 * 0.1 * 0.75, 0.075 * step);
  EXPECT_EQ(cpu::parallax(field, {0.3, 0.4}, {0, 0, 1}, 0.1, 16).uv.x, 0.3);
}

/// A ramp: depth 1 - (256 u - 1/2) / 255. The ray's depth t is the field's at u + way t.
TEST(Parallax, MeetsARampWhereGeometrySays) {
  Grid<u8vec4> ramp{256, 2};
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 256; ++x) ramp(x, y) = u8vec4(x);
  for (const double lean : {-0.75, -0.2, 0.4, 0.75})
    for (const double u : {0.35, 0.5, 0.65}) {
      const double scale = 0.2, way = -scale * lean;
      const double depth = (1 - (256 * u - 0.5) / 255) / (1 + 256 * way / 255);
      for (const int layers : {16, 100}) {
        const cpu::ParallaxHit hit = cpu::parallax(ramp, {u, 0.3}, {lean, 0, 1}, scale, layers);
        EXPECT_NEAR(hit.depth, depth, 1 / 256.0 / layers) << lean << " " << u;
        EXPECT_NEAR(hit.uv.x, u + way * depth, std::abs(way) / 256 / layers);
        EXPECT_EQ(hit.uv.y, 0.3);
      }
    }
}

/// Half of a cylinder's top, of radius 1 around u = 1/2: heights (sqrt(1 - x^2) - low) / (1 - low),
/// low = sqrt(3) / 2 at the sides, x = u - 1/2.
TEST(Parallax, MeetsACylinderWhereGeometrySays) {
  const double low = std::sqrt(0.75), high = 1 - low;
  Grid<u8vec4> field{256, 2};
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 256; ++x) {
      const double c = (x + 0.5) / 256 - 0.5;
      field(x, y) = u8vec4(std::uint8_t(std::lround(255 * (std::sqrt(1 - c * c) - low) / high)));
    }
  for (const double way : {-0.1, -0.03, 0.05, 0.1})
    for (const double u : {0.3, 0.45, 0.5, 0.62}) {
      // (1 - t) high + low = sqrt(1 - (x + way t)^2), squared.
      const double x = u - 0.5, a = high * high + way * way, b = x * way - high, c = x * x;
      const double depth = (-b - std::sqrt(b * b - a * c)) / a;
      const cpu::ParallaxHit hit = cpu::parallax(field, {u, 0.3}, {-way, 0, 0.1}, 0.1, 64);
      // The field is off by half a code and by a chord's sag, 11.5 / 8 / 256^2; the ray meets it
      // where its depth and that of the field, of slope below 4.4 way, change places.
      const double error = 0.5 / 255 + 2.2e-5;
      EXPECT_NEAR(hit.depth, depth, error / (1 - 4.4 * std::abs(way)) + 1 / 256.0 / 64)
          << way << " " << u;
    }
}

/// A square of 3x3 squares in x and z, displaced along y; seen so that factors differ.
DisplacementProblem rough_square() {
  Random random{8};
  DisplacementProblem p;
  p.heights = texture_test::random_image(8, 8, random);
  p.scale = 0.3f;
  p.size = {400, 400};
  p.max_pixels = 8;
  const auto corner = [](int x, int y) {
    const vec2 uv = vec2(x, y) / 3.0f;
    return DisplacementCorner{{uv.x, 0, uv.y}, {0, 1, 0}, uv};
  };
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x)
      for (const ivec2 c :
           {ivec2(0, 0), ivec2(1, 0), ivec2(1, 1), ivec2(0, 0), ivec2(1, 1), ivec2(0, 1)})
        p.corners.push_back(corner(x + c.x, y + c.y));
  p.clip_from_world = mat4(0.0f);  // x and y over 0.2 + 2 z
  p.clip_from_world[0][0] = p.clip_from_world[1][1] = 1;
  p.clip_from_world[2][3] = 2;
  p.clip_from_world[3][3] = 0.2f;
  return p;
}

TEST(Displacement, LeavesNoCracks) {
  const DisplacedMesh mesh = gpu::displace(test_context(), rough_square());
  std::set<std::uint32_t> factors;
  for (const uvec4& f : mesh.factors) factors.insert({f.x, f.y, f.z});
  EXPECT_GT(factors.size(), 2u) << "the test needs edges that differ";
  using Key = std::array<float, 6>;
  std::multiset<Key> edges;
  const auto key = [](const vec3& a, const vec3& b) { return Key{a.x, a.y, a.z, b.x, b.y, b.z}; };
  for (std::size_t i = 0; i < mesh.corners.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      const vec3 a = mesh.corners[i + k], b = mesh.corners[i + (k + 1) % 3];
      if (a != b) edges.insert(key(a, b));
    }
  for (const Key& e : edges) {
    const bool on_border =
        (e[0] == e[3] && (e[0] == 0 || e[0] == 1)) || (e[2] == e[5] && (e[2] == 0 || e[2] == 1));
    if (on_border) continue;
    EXPECT_EQ(edges.count(e), edges.count(Key{e[3], e[4], e[5], e[0], e[1], e[2]}))
        << e[0] << " " << e[2] << " to " << e[3] << " " << e[5];
  }
}

}  // namespace
}  // namespace parity
