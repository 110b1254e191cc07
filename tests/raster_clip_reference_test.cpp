#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "cpu_reference/raster/clip.h"
#include "cpu_reference/raster/edge_coverage.h"
#include "cpu_reference/raster/rasterize.h"
#include "cpu_reference/raster/scanline_fill.h"
#include "tests/raster/triangle_lists.h"

namespace parity {
namespace {

// 1.1: clipping

TEST(RasterReference, ATriangleInsideStaysAsItIs) {
  const std::array<dvec4, 3> corners{dvec4(0, 0, 0.5, 1), dvec4(1, 0, 0.2, 2), dvec4(0, 1, 1, 1)};
  const ClippedPolygon polygon = cpu::clip_triangle(corners, 1.0);
  ASSERT_EQ(polygon.count, 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(polygon.position[i], corners[i]);
}

TEST(RasterReference, ClippingAtTheNearPlaneHalvesATriangle) {
  const ClippedPolygon polygon =
      cpu::clip_triangle({dvec4(0, 0, -1, 1), dvec4(0.5, 0, 1, 1), dvec4(0, 0.5, 1, 1)}, 2.0);
  ASSERT_EQ(polygon.count, 4u);
  EXPECT_EQ(polygon.position[0], dvec4(0.25, 0, 0, 1));
  EXPECT_EQ(polygon.position[3], dvec4(0, 0.25, 0, 1));
  EXPECT_EQ(polygon.barycentric[0], dvec3(0.5, 0.5, 0));
}

TEST(RasterReference, NothingIsLeftBehindTheEyeOrOfNumbersThatAreNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const dvec4 p{0.1, 0.2, 0.5, 1.0}, q{0.3, 0.1, 0.5, 1.0};
  EXPECT_EQ(cpu::clip_triangle({-p, -q, dvec4(0, 0, 0, -1)}, 2.0).count, 0u);
  EXPECT_EQ(cpu::clip_triangle({p, q, dvec4(nan, 0, 0, 1)}, 2.0).count, 0u);
  EXPECT_EQ(cpu::clip_triangle({p, q, dvec4(0, 0, 0, 1.0 / 0.0)}, 2.0).count, 0u);
  EXPECT_EQ(cpu::clip_triangle({dvec4(0), dvec4(0), dvec4(0)}, 2.0).count, 0u);
}

/// Smallest of the signed distances of a point to the planes of the view volume.
double depth_inside(dvec4 p, double g) {
  return std::min({p.w, p.z, p.w - p.z, g * p.w - std::abs(p.x), g * p.w - std::abs(p.y)});
}

/// Smallest of the signed areas that a point of barycentric space spans with the polygon's edges.
double depth_inside(dvec3 b, const ClippedPolygon& polygon) {
  double smallest = polygon.count < 3 ? -1.0 : 1.0;
  for (std::uint32_t i = 0; i < polygon.count; ++i) {
    const dvec2 from{polygon.barycentric[i].y, polygon.barycentric[i].z};
    const dvec2 to{polygon.barycentric[(i + 1) % polygon.count].y,
                   polygon.barycentric[(i + 1) % polygon.count].z};
    const dvec2 edge = to - from, p = dvec2(b.y, b.z) - from;
    smallest = std::min(smallest, edge.x * p.y - edge.y * p.x);
  }
  return smallest;
}

TEST(RasterReference, TheClippedPolygonHoldsExactlyThePointsInsideTheVolume) {
  std::mt19937 random{17};
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit;
  std::uint32_t most_corners = 0;
  int judged = 0;
  for (int i = 0; i < 5000; ++i) {
    std::array<dvec4, 3> corners;
    for (dvec4& c : corners)
      c = dvec4(2.0 * normal(random), 2.0 * normal(random), normal(random), 0.5 + normal(random));
    const ClippedPolygon polygon = cpu::clip_triangle(corners, 1.5);
    most_corners = std::max(most_corners, polygon.count);
    for (std::uint32_t k = 0; k < polygon.count; ++k) {
      const dvec3 b = polygon.barycentric[k];
      EXPECT_GE(depth_inside(polygon.position[k], 1.5), -1e-13);  // roundings of numbers up to 10
      EXPECT_LE(
          glm::length(b.x * corners[0] + b.y * corners[1] + b.z * corners[2] - polygon.position[k]),
          1e-13);
    }
    for (int k = 0; k < 20; ++k) {
      double s = unit(random), t = unit(random);
      if (s + t > 1.0) s = 1.0 - s, t = 1.0 - t;
      const dvec3 b{1.0 - s - t, s, t};
      const double inside =
          depth_inside(b.x * corners[0] + b.y * corners[1] + b.z * corners[2], 1.5);
      if (std::abs(inside) < 1e-9) continue;
      ++judged;
      EXPECT_EQ(inside > 0.0, depth_inside(b, polygon) > 0.0);
    }
  }
  EXPECT_GE(most_corners, 7u);
  EXPECT_GT(judged, 99000);
}

TEST(RasterReference, NeighboursMeetAtTheSameClippedPoint) {
  const dvec4 a{0.1, 0.7, -0.3, 0.9}, b{-0.4, 0.2, 0.6, 1.1}, c{0.5, -0.2, 0.4, 1.0},
      d{-0.9, 0.9, 0.3, 1.2};
  const ClippedPolygon one = cpu::clip_triangle({a, b, c}, 2.0);
  const ClippedPolygon other = cpu::clip_triangle({b, a, d}, 2.0);
  int common = 0;
  for (std::uint32_t i = 0; i < one.count; ++i)
    for (std::uint32_t k = 0; k < other.count; ++k)
      common += one.position[i].z == 0.0 && one.position[i] == other.position[k];
  EXPECT_EQ(common, 1);
}

/// Points (x, -1, z) of the floor seen from one metre above it along -z: near 0.25 m, no far.
vec4 floor_point(double x, double z) { return vec4(float(x), 1.0f, 0.25f, float(-z)); }

// The horizon is at y = 32; rows below it see the floor. Corners lie behind the eye and far out.
std::size_t wrong_floor_samples(int samples, Snapping snapping) {
  TriangleList list = empty_list(64, 64, samples);
  const int n = 9;
  for (int z = 0; z < n; ++z)
    for (int x = 0; x < n; ++x)
      list.clip_positions.push_back(floor_point(250.0 * (x - 4.2), 100.0 * (z - 7.3)));
  for (int z = 0; z + 1 < n; ++z)
    for (int x = 0; x + 1 < n; ++x) {
      const auto a = std::uint32_t(z * n + x);
      list.triangles.emplace_back(a, a + 1, a + n);
      list.triangles.emplace_back(a + 1, a + n + 1, a + n);
    }
  const Coverage coverage = cpu::span_coverage(list, snapping);
  std::size_t wrong = 0;
  for (int y = 0; y < 64; ++y)
    for (int i = 0; i < 64 * samples; ++i) {
      const std::uint32_t count = coverage.count[std::size_t(y * 64 * samples + i)];
      if (y < 32) wrong += count != 0;
      if (y > 32) wrong += count != 1;  // row 32 meets the floor's far edge
    }
  EXPECT_TRUE(cpu::edge_coverage(list, snapping) == coverage);
  EXPECT_TRUE(cpu::scanline_fill(list, snapping) == coverage);
  return wrong;
}

TEST(RasterReference, AFloorThroughTheEyePlaneCoversEverySampleOnce) {
  for (const int samples : {1, 2, 4, 8})
    for (const Snapping snapping : {Snapping::mesa, Snapping::swiftshader})
      EXPECT_EQ(wrong_floor_samples(samples, snapping), 0u) << samples;
}

// Each pixel's ray against the triangle: inside if the three volumes have one sign and it is hit in
// front of the near plane.
TEST(RasterReference, TrianglesAcrossTheEyePlaneCoverWhatRaysSee) {
  std::mt19937 random{19};
  std::normal_distribution<float> normal;
  int judged = 0, covered = 0, wrong = 0;
  for (int i = 0; i < 200; ++i) {
    TriangleList list = empty_list(32, 32, 1);
    dvec3 p[3];
    vec4 clip[3];
    for (int k = 0; k < 3; ++k) {
      const vec3 eye{3.0f * normal(random), 3.0f * normal(random), 3.0f * normal(random)};
      p[k] = dvec3(eye.x, eye.y, eye.z);
      clip[k] = vec4(eye.x, eye.y, eye.z - 0.5f, eye.z);  // looks along +z, near .5 m, no far
    }
    add_triangle(list, clip[0], clip[1], clip[2]);
    const Coverage coverage = cpu::edge_coverage(list, Snapping::mesa);
    const double volume = glm::dot(p[0], glm::cross(p[1], p[2]));
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 32; ++x) {
        const auto margin = [&](dvec2 offset) {  // > 0: hit
          const dvec3 ray{(x + 0.5 + offset.x) / 16.0 - 1.0, (y + 0.5 + offset.y) / 16.0 - 1.0,
                          1.0};
          const dvec3 b =
              dvec3(glm::dot(ray, glm::cross(p[1], p[2])), glm::dot(ray, glm::cross(p[2], p[0])),
                    glm::dot(ray, glm::cross(p[0], p[1]))) /
              volume;
          const double distance = 1.0 / (b.x + b.y + b.z);
          return std::min({b.x, b.y, b.z, distance - 0.5});
        };
        // Not judged within a grid step of a border.
        const bool hit = margin({0, 0}) > 0.0;
        bool clear = true;
        for (const dvec2 o : {dvec2(1, 1), dvec2(1, -1), dvec2(-1, 1), dvec2(-1, -1)})
          clear = clear && (margin(o / 256.0) > 0.0) == hit;
        if (!clear) continue;
        ++judged;
        covered += hit;
        wrong += coverage.count[std::size_t(y * 32 + x)] != (hit ? 1u : 0u);
      }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(judged, 190000);
  EXPECT_GT(covered, 10000);
}

TEST(RasterReference, ATriangleLargerThanTheGuardBandCoversEverythingOnce) {
  TriangleList list = empty_list(50, 40, 4);
  add_triangle(list, {-1e6f, -1e6f, 0.5f, 1.0f}, {4e6f, -1e6f, 0.5f, 1.0f},
               {-1e6f, 4e6f, 0.5f, 1.0f});
  EXPECT_EQ(samples_not_covered_once(cpu::span_coverage(list, Snapping::mesa)), 0u);
  EXPECT_EQ(samples_not_covered_once(cpu::edge_coverage(list, Snapping::mesa)), 0u);
}

TEST(RasterReference, NumbersOfAllKindsDoNoHarm) {
  TriangleList list = empty_list(20, 20, 4);
  std::mt19937 random{23};
  const float infinity = std::numeric_limits<float>::infinity();
  const std::vector<float> numbers{0.0f,   1.0f,  -1.0f,    0.5f,      1e30f, -1e30f,
                                   1e-42f, 3e38f, infinity, -infinity, NAN,   1e-20f};
  for (int i = 0; i < 20000; ++i) {
    vec4 p[3];
    for (vec4& corner : p)
      for (int k = 0; k < 4; ++k) corner[k] = numbers[random() % numbers.size()];
    add_triangle(list, p[0], p[1], p[2]);
  }
  const Coverage coverage = cpu::span_coverage(list, Snapping::mesa);
  EXPECT_TRUE(cpu::scanline_fill(list, Snapping::mesa) == coverage);
  EXPECT_TRUE(cpu::edge_coverage(list, Snapping::mesa) == coverage);
}

TEST(RasterReference, RefusesListsThatDoNotFit) {
  TriangleList list = empty_list(4, 4, 1);
  EXPECT_EQ(cpu::edge_coverage(list, Snapping::mesa).count, std::vector<std::uint32_t>(16));
  list.triangles.emplace_back(0u, 1u, 2u);
  EXPECT_THROW(cpu::edge_coverage(list, Snapping::mesa), std::invalid_argument);
  EXPECT_THROW(cpu::clip(list, 2.0), std::invalid_argument);
  EXPECT_THROW(cpu::clip(empty_list(4, 4, 1), 0.5), std::invalid_argument);
  EXPECT_THROW(cpu::span_coverage(empty_list(4, 4, 3), Snapping::mesa), std::invalid_argument);
  EXPECT_THROW(cpu::span_coverage(empty_list(-1, 4, 1), Snapping::mesa), std::invalid_argument);
  EXPECT_THROW(cpu::span_coverage(empty_list(4, 20000, 1), Snapping::mesa), std::invalid_argument);
  EXPECT_TRUE(cpu::span_coverage(empty_list(0, 0, 1), Snapping::mesa).count.empty());
}

}  // namespace
}  // namespace parity
