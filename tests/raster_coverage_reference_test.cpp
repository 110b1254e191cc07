#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <limits>
#include <random>

#include "cpu_reference/raster/clip.h"
#include "cpu_reference/raster/edge_coverage.h"
#include "cpu_reference/raster/rasterize.h"
#include "cpu_reference/raster/scanline_fill.h"
#include "cpu_reference/raster/triangle_list.h"
#include "cpu_reference/raster/viewport.h"
#include "tests/raster/errata_edge.h"

namespace parity {
namespace {

bool operator==(const Coverage& a, const Coverage& b) {
  return a.count == b.count && a.last == b.last;
}

TriangleList empty_list(int width, int height, int samples) {
  return {
      .width = width, .height = height, .samples = samples, .clip_positions = {}, .triangles = {}};
}

vec4 clip_at(const TriangleList& list, dvec2 window) {
  return {float(2.0 * window.x / list.width - 1.0), float(2.0 * window.y / list.height - 1.0), 0.5f,
          1.0f};
}

void add_triangle(TriangleList& list, vec4 a, vec4 b, vec4 c) {
  const auto first = std::uint32_t(list.clip_positions.size());
  list.clip_positions.insert(list.clip_positions.end(), {a, b, c});
  list.triangles.emplace_back(first, first + 1, first + 2);
}

void add_window_triangle(TriangleList& list, dvec2 a, dvec2 b, dvec2 c) {
  add_triangle(list, clip_at(list, a), clip_at(list, b), clip_at(list, c));
}

/// Of all sizes and shapes: every third with corners on half pixels (exact ties), every fifth a
/// sliver.
TriangleList random_triangles(int width, int height, int samples, int count, unsigned seed) {
  TriangleList list = empty_list(width, height, samples);
  std::mt19937 random{seed};
  std::uniform_real_distribution<double> unit;
  for (int i = 0; i < count; ++i) {
    const dvec2 center{unit(random) * width, unit(random) * height};
    const double size = std::exp2(6.0 * unit(random) - 1.0);
    dvec2 p[3];
    for (dvec2& corner : p) corner = center + size * (dvec2(unit(random), unit(random)) - 0.5);
    if (i % 5 == 0) p[2] = 0.5 * (p[0] + p[1]) + 0.01 * (p[2] - p[0]);
    if (i % 3 == 0)
      for (dvec2& corner : p) corner = glm::round(corner * 2.0) / 2.0;
    add_window_triangle(list, p[0], p[1], p[2]);
  }
  return list;
}

/// A grid of cells, two triangles each with random diagonals, its inner points moved at random: on
/// the lattice of half pixels if `ties`. Larger than the target by a margin.
TriangleList watertight_mesh(int width, int height, int samples, int cells, bool ties) {
  TriangleList list = empty_list(width, height, samples);
  std::mt19937 random{unsigned(cells)};
  std::uniform_real_distribution<double> unit;
  const int n = cells + 1;
  const double margin = 3.0;
  const dvec2 cell = (dvec2(width, height) + 2.0 * margin) / double(cells);
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      dvec2 p = dvec2(x, y) * cell - margin;
      if (x > 0 && x < cells && y > 0 && y < cells)
        p += cell * 0.45 * (dvec2(unit(random), unit(random)) - 0.5);
      if (ties) p = glm::round(p * 2.0) / 2.0;
      list.clip_positions.push_back(clip_at(list, p));
    }
  for (int y = 0; y < cells; ++y)
    for (int x = 0; x < cells; ++x) {
      const auto a = std::uint32_t(y * n + x), b = a + 1, d = a + std::uint32_t(n), c = d + 1;
      if (unit(random) < 0.5) {
        list.triangles.emplace_back(a, b, c);
        list.triangles.emplace_back(a, c, d);
      } else {
        list.triangles.emplace_back(a, b, d);
        list.triangles.emplace_back(b, c, d);
      }
    }
  return list;
}

std::size_t samples_not_covered_once(const Coverage& coverage) {
  std::size_t wrong = 0;
  for (const std::uint32_t count : coverage.count) wrong += count != 1;
  return wrong;
}

// 1.2: pixels and the viewport

TEST(RasterReference, ViewportMapsNdcCornersToTheWindow) {
  const std::vector<vec4> clip{{-1, -1, 0, 1}, {2, 2, 2, 2}, {0, 0, 1, 4}};
  const std::vector<dvec4> window = cpu::to_window(clip, 640, 480);
  EXPECT_EQ(window[0], dvec4(0, 0, 0, 1));
  EXPECT_EQ(window[1], dvec4(640, 480, 1, 0.5));
  EXPECT_EQ(window[2], dvec4(320, 240, 0.25, 0.25));
}

TEST(RasterReference, SnapRoundsToTheGridTiesToEven) {
  const auto x = [](float window, int samples, Snapping snapping) {
    return cpu::snap({window / 128.0f - 1.0f, 0.0f, 0.0f, 1.0f}, 256, 256, samples, snapping).x;
  };
  EXPECT_EQ(x(10.0f, 4, Snapping::mesa), 2560);
  EXPECT_EQ(x(10.0f, 1, Snapping::mesa), 2560 - 128);
  EXPECT_EQ(x(10.0f + 0.5f / 256.0f, 4, Snapping::mesa), 2560);
  EXPECT_EQ(x(10.0f + 1.5f / 256.0f, 4, Snapping::mesa), 2562);
  EXPECT_EQ(x(10.0f, 4, Snapping::swiftshader), 152);
  EXPECT_EQ(x(10.0f + 0.5f / 16.0f, 1, Snapping::swiftshader), 152);
  EXPECT_EQ(x(10.0f + 1.5f / 16.0f, 1, Snapping::swiftshader), 154);
}

TEST(RasterReference, SampleGridsHoldTheStandardPlaces) {
  EXPECT_EQ(cpu::sample_grid(1, Snapping::mesa).places[0], ivec2(0));
  EXPECT_EQ(cpu::sample_grid(4, Snapping::mesa).places[0], ivec2(96, 32));
  EXPECT_EQ(cpu::sample_grid(4, Snapping::swiftshader).places[0], ivec2(-2, -6));
  EXPECT_THROW(cpu::sample_grid(3, Snapping::mesa), std::invalid_argument);
}

TEST(RasterReference, ARectangleCoversThePixelsWhoseCentresItHolds) {
  TriangleList list = empty_list(16, 16, 1);
  // [2.5, 7.5) x [3.5, 9]: centres 2.5 to 6.5, the right edge excluded, and 3.5 to 8.5
  add_window_triangle(list, {2.5, 3.5}, {7.5, 3.5}, {7.5, 9.0});
  add_window_triangle(list, {2.5, 3.5}, {7.5, 9.0}, {2.5, 9.0});
  const Coverage coverage = cpu::edge_coverage(list, Snapping::mesa);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x)
      EXPECT_EQ(coverage.count[std::size_t(y * 16 + x)], x >= 2 && x <= 6 && y >= 3 && y <= 8)
          << x << " " << y;
}

// 1.4: edge functions

TEST(RasterReference, EdgeFunctionsSumToTwiceTheArea) {
  std::mt19937 random{5};
  std::uniform_int_distribution<int> place{-5000, 5000};
  for (int i = 0; i < 1000; ++i) {
    const ivec2 a{place(random), place(random)}, b{place(random), place(random)},
        c{place(random), place(random)}, p{place(random), place(random)};
    const auto e = [&](ivec2 from, ivec2 to) {  // without the bias of the tie rule
      const cpu::EdgeFunction f = cpu::edge_function(from, to);
      return f.at(p.x, p.y) - f.at(from.x, from.y);
    };
    const ivec2 u = b - a, v = c - a;
    EXPECT_EQ(e(a, b) + e(b, c) + e(c, a), std::int64_t(u.x) * v.y - std::int64_t(u.y) * v.x);
    EXPECT_EQ(e(a, b), -e(b, a));
  }
}

TEST(RasterReference, SamplesOnAnEdgeBelongToTopAndLeftEdges) {
  const auto is_inside_on = [](ivec2 a, ivec2 b) {
    return cpu::edge_function(a, b).at(a.x, a.y) >= 0;
  };
  EXPECT_TRUE(is_inside_on({0, 0}, {9, 0}));   // top, clockwise with y down
  EXPECT_FALSE(is_inside_on({9, 0}, {0, 0}));  // bottom
  EXPECT_TRUE(is_inside_on({0, 9}, {0, 0}));   // left
  EXPECT_FALSE(is_inside_on({0, 0}, {0, 9}));  // right
  EXPECT_TRUE(is_inside_on({0, 9}, {5, 0}));   // rising
  EXPECT_FALSE(is_inside_on({5, 0}, {9, 9}));  // falling
}

TEST(RasterReference, ErratumEdgeIncrement) {
  EXPECT_TRUE(steps_right_as_the_edge_function(
      [](std::int64_t e, ivec2 a, ivec2 b) { return e + cpu::edge_function(a, b).dx; }));
  EXPECT_FALSE(steps_right_as_the_edge_function(
      [](std::int64_t e, ivec2 a, ivec2 b) { return e + (b.y - a.y); }));
}

struct Device {
  int samples;
  Snapping snapping;
};

class RasterReferenceOn : public testing::TestWithParam<Device> {};

INSTANTIATE_TEST_SUITE_P(Devices, RasterReferenceOn,
                         testing::Values(Device{1, Snapping::mesa}, Device{2, Snapping::mesa},
                                         Device{4, Snapping::mesa}, Device{8, Snapping::mesa},
                                         Device{1, Snapping::swiftshader},
                                         Device{4, Snapping::swiftshader}),
                         [](const auto& device) {
                           return (device.param.snapping == Snapping::mesa ? "Mesa"
                                                                           : "SwiftShader") +
                                  std::to_string(device.param.samples);
                         });

TEST_P(RasterReferenceOn, WatertightMeshesCoverEverySampleOnce) {
  const auto [samples, snapping] = GetParam();
  for (const int cells : {1, 2, 7, 19})
    for (const bool ties : {false, true}) {
      const TriangleList mesh = watertight_mesh(131, 67, samples, cells, ties);
      EXPECT_EQ(samples_not_covered_once(cpu::edge_coverage(mesh, snapping)), 0u)
          << cells << " cells, ties " << ties;
      EXPECT_EQ(samples_not_covered_once(cpu::scanline_fill(mesh, snapping)), 0u);
      EXPECT_EQ(samples_not_covered_once(cpu::span_coverage(mesh, snapping)), 0u);
    }
}

TEST_P(RasterReferenceOn, AFanAroundASampleCoversEverySampleOnce) {
  const auto [samples, snapping] = GetParam();
  for (const ivec2 place : standard_sample_places(samples)) {
    TriangleList list = empty_list(33, 29, samples);
    const dvec2 center = dvec2(16.0, 14.0) + dvec2(place) / 16.0;
    for (int i = 0; i < 12; ++i) {
      const auto rim = [&](int k) {
        return center +
               64.0 * dvec2(std::cos(k * 0.52359877559829887), std::sin(k * 0.52359877559829887));
      };
      add_window_triangle(list, center, rim(i), rim((i + 1) % 12));
    }
    EXPECT_EQ(samples_not_covered_once(cpu::edge_coverage(list, snapping)), 0u);
  }
}

TEST_P(RasterReferenceOn, AllTraversalsAgree) {
  const auto [samples, snapping] = GetParam();
  const TriangleList list = random_triangles(61, 47, samples, 2000, 7);
  const Coverage direct = cpu::edge_coverage_direct(list, snapping);
  EXPECT_TRUE(cpu::edge_coverage(list, snapping) == direct);
  EXPECT_TRUE(cpu::edge_coverage_brute_force(list, snapping) == direct);
  EXPECT_TRUE(cpu::span_coverage(list, snapping) == direct);
  EXPECT_TRUE(cpu::scanline_fill(list, snapping) == direct);
}

TEST(RasterReference, ScanlinesEqualEdgeFunctionsForAHundredThousandTriangles) {
  const TriangleList list = random_triangles(61, 47, 1, 100000, 11);
  const Coverage edges = cpu::edge_coverage(list, Snapping::mesa);
  EXPECT_TRUE(cpu::scanline_fill(list, Snapping::mesa) == edges);
  EXPECT_TRUE(cpu::span_coverage(list, Snapping::mesa) == edges);
}

TEST(RasterReference, CoverageDoesNotDependOnTheNumberOfThreads) {
  const int threads = omp_get_max_threads();
  const TriangleList list = random_triangles(131, 97, 4, 3000, 13);
  omp_set_num_threads(1);
  const Coverage alone = cpu::span_coverage(list, Snapping::mesa);
  for (const int count : {2, 3, 5}) {
    omp_set_num_threads(count);
    EXPECT_TRUE(cpu::span_coverage(list, Snapping::mesa) == alone) << count;
  }
  omp_set_num_threads(threads);
}

TEST(RasterReference, TheAreaCoveredTendsToThatOfTheTriangle) {
  TriangleList list = empty_list(200, 200, 8);
  add_window_triangle(list, {10.3, 20.7}, {180.2, 60.1}, {70.9, 190.4});
  double covered = 0.0;
  for (const std::uint32_t count : cpu::edge_coverage(list, Snapping::mesa).count) covered += count;
  const dvec2 u{169.9, 39.4}, v{60.6, 169.7};
  const double area = 0.5 * (u.x * v.y - u.y * v.x);
  // A sample stands for 1/8 px^2. The error is that of the border: about 540 px of it, of which
  // each crosses a sample's cell at random; 4 standard deviations of sqrt(540 sqrt 8 / 12) samples.
  EXPECT_NEAR(covered / 8.0, area, 4.0 * std::sqrt(540.0 * std::sqrt(8.0) / 12.0) / 8.0);
}

// Culling

TEST(RasterReference, CullsByTheSideThatIsSeen) {
  TriangleList list = empty_list(8, 8, 1);
  add_window_triangle(list, {0, 0}, {0, 8}, {8, 0});  // counter-clockwise on the screen
  const auto covers = [&](Cull cull, bool mirrored) {
    list.cull = cull;
    const auto triangles = cpu::set_up(list, Snapping::mesa, mirrored);
    if (!triangles.empty()) {
      EXPECT_EQ(triangles[0].front, !mirrored);
    }
    return !triangles.empty();
  };
  EXPECT_TRUE(covers(Cull::none, false));
  EXPECT_TRUE(covers(Cull::back, false));
  EXPECT_FALSE(covers(Cull::front, false));
  EXPECT_FALSE(covers(Cull::back, true));
  EXPECT_TRUE(covers(Cull::front, true));
}

TEST(RasterReference, TrianglesWithoutAreaAreDropped) {
  TriangleList list = empty_list(8, 8, 1);
  add_window_triangle(list, {1, 1}, {3, 3}, {5, 5});
  add_window_triangle(list, {1, 1}, {1, 1}, {5, 5});
  add_window_triangle(list, {1, 1}, {1.001, 1}, {1, 1.001});
  EXPECT_TRUE(cpu::set_up(list, Snapping::mesa, false).empty());
}

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
TEST_P(RasterReferenceOn, AFloorThroughTheEyePlaneCoversEverySampleOnce) {
  const auto [samples, snapping] = GetParam();
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
  EXPECT_EQ(wrong, 0u);
  EXPECT_TRUE(cpu::edge_coverage(list, snapping) == coverage);
  EXPECT_TRUE(cpu::scanline_fill(list, snapping) == coverage);
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
