#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <random>

#include "cpu_reference/raster/edge_coverage.h"
#include "cpu_reference/raster/rasterize.h"
#include "cpu_reference/raster/scanline_fill.h"
#include "cpu_reference/raster/viewport.h"
#include "tests/raster/errata_edge.h"
#include "tests/raster/triangle_lists.h"

namespace parity {
namespace {

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

TEST(RasterReference, ARasterisedTriangleStaysInItsBox) {
  const cpu::PixelBox box{3, 2, 11, 9};
  std::mt19937 random{29};
  std::uniform_int_distribution<int> place{-200, 400};
  for (const int samples : {1, 4}) {
    const cpu::SampleGrid grid = cpu::sample_grid(samples, Snapping::swiftshader);
    for (int i = 0; i < 50000; ++i) {
      cpu::SnappedTriangle triangle;
      for (ivec2& corner : triangle.corners) corner = {place(random), place(random)};
      if (i % 2 == 0) triangle.corners[1].y = triangle.corners[0].y;  // a horizontal edge
      bool stays = true;
      cpu::rasterize_triangle(triangle, grid, box, [&](int x, int y, std::uint32_t) {
        stays = stays && x >= box.left && x < box.right && y >= box.top && y < box.bottom;
      });
      ASSERT_TRUE(stays) << i;
    }
  }
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

}  // namespace
}  // namespace parity
