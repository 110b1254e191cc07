#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "cpu_reference/raster/bresenham.h"
#include "cpu_reference/raster/dda_line.h"
#include "cpu_reference/raster/edge_coverage.h"
#include "cpu_reference/raster/polygon_fill.h"
#include "cpu_reference/raster/wide_line.h"
#include "tests/raster/errata_line.h"

namespace parity {
namespace {

std::vector<ivec2> bresenham(const Segment& segment) {
  return cpu::bresenham(std::vector{segment})[0];
}

std::vector<ivec2> dda(const Segment& segment) { return cpu::dda_line(std::vector{segment})[0]; }

/// The formula of notes 1.9 as it stands, in the first octant; e is never reset.
std::vector<ivec2> notes_line(const Segment& segment, bool with_reset) {
  const int dx = segment.end.x - segment.begin.x, dy = segment.end.y - segment.begin.y;
  std::vector<ivec2> pixels;
  int e = 0, y = segment.begin.y;
  for (int x = segment.begin.x; x <= segment.end.x; ++x) {
    pixels.emplace_back(x, y);
    e += dy;
    if (e > dx) {
      ++y;
      if (with_reset) e -= dx;
    }
  }
  return pixels;
}

TEST(RasterReference, ErratumBresenham) {
  EXPECT_TRUE(draws_nearest_pixels(bresenham));
  for (const bool with_reset : {false, true}) {
    const auto notes = [&](const Segment& s) { return notes_line(s, with_reset); };
    EXPECT_FALSE(draws_nearest_pixels(notes));
    for (const Segment s : {Segment{{0, 0}, {10, 3}}, Segment{{0, 0}, {10, 7}}})
      EXPECT_FALSE(is_line_of_nearest_pixels(s, notes(s)));
  }
  EXPECT_NE(notes_line({{0, 0}, {10, 10}}, true).back(), ivec2(10, 10));  // never reached
}

TEST(RasterReference, BresenhamIsExactRationalRounding) {
  std::mt19937 random{1};
  std::uniform_int_distribution<int> place{-500, 500};
  for (int i = 0; i < 500; ++i) {
    const Segment s{{place(random), place(random)}, {place(random), place(random)}};
    const ivec2 d = s.end - s.begin;
    const int major = std::abs(d.y) > std::abs(d.x) ? 1 : 0;
    const std::int64_t length = std::abs(d[major]), rise = std::abs(d[1 - major]);
    const std::vector<ivec2> pixels = bresenham(s);
    EXPECT_TRUE(is_line_of_nearest_pixels(s, pixels));
    for (std::int64_t k = 0; k <= length; ++k) {
      // ceil(k rise / length - 1/2): to the nearest, halves towards the begin
      const std::int64_t nearest = length == 0 ? 0 : (2 * k * rise + length - 1) / (2 * length);
      EXPECT_EQ(std::abs(pixels[std::size_t(k)][1 - major] - s.begin[1 - major]), nearest);
    }
  }
}

TEST(RasterReference, LinesOfOnePixelAndNoLines) {
  EXPECT_EQ(bresenham({{4, -2}, {4, -2}}), (std::vector<ivec2>{{4, -2}}));
  EXPECT_EQ(dda({{4, -2}, {4, -2}}), (std::vector<ivec2>{{4, -2}}));
  EXPECT_TRUE(cpu::bresenham({}).empty());
  EXPECT_TRUE(cpu::dda_line({}).empty());
  EXPECT_THROW(bresenham({{0, 0}, {1 << 21, 0}}), std::invalid_argument);
  EXPECT_THROW(dda({{std::numeric_limits<int>::min(), 0}, {0, 0}}), std::invalid_argument);
}

TEST(RasterReference, DdaStaysWithinHalfAPixelAndItsDrift) {
  std::mt19937 random{2};
  std::uniform_int_distribution<int> place{-3000, 3000};
  for (int i = 0; i < 200; ++i) {
    const Segment s{{place(random), place(random)}, {place(random), place(random)}};
    const ivec2 d = s.end - s.begin;
    const int n = std::max(std::abs(d.x), std::abs(d.y));
    const std::vector<ivec2> pixels = dda(s);
    ASSERT_EQ(pixels.size(), std::size_t(n) + 1);
    const double size = std::max(std::abs(s.begin.x), std::abs(s.begin.y)) + n + 1.0;
    const double drift = n * 0x1p-24 * size;
    for (int k = 0; k <= n; ++k) {
      const dvec2 ideal = dvec2(s.begin) + dvec2(d) * (double(k) / std::max(n, 1));
      const dvec2 off = glm::abs(dvec2(pixels[std::size_t(k)]) - ideal);
      EXPECT_LE(std::max(off.x, off.y), 0.5 + drift);
    }
    EXPECT_EQ(pixels.back(), s.end);  // the drift is far below half a pixel here
  }
}

TEST(RasterReference, DdaRoundsLikeBresenhamButForTies) {
  for (int y = -30; y <= 30; ++y)
    for (int x = -30; x <= 30; ++x)
      EXPECT_TRUE(is_line_of_nearest_pixels({{0, 0}, {x, y}}, dda({{0, 0}, {x, y}})));
}

// Wide lines

int covered(const Grid<std::uint8_t>& grid) {
  int count = 0;
  for (const std::uint8_t c : grid) count += c;
  return count;
}

// Its borders run through pixel centres; those left and on top belong to it.
TEST(RasterReference, AWideLineAlongAnAxisIsARectangle) {
  const Grid<std::uint8_t> line = cpu::wide_line({2.5f, 10.0f}, {12.5f, 10.0f}, 3.0f, 20, 20);
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x)
      EXPECT_EQ(line(x, y), x >= 2 && x < 12 && y >= 8 && y < 11) << x << " " << y;
}

TEST(RasterReference, AWideLineIsThePolygonAroundIt) {
  std::mt19937 random{3};
  std::uniform_real_distribution<float> place{-5.0f, 45.0f};
  int judged = 0;
  for (int i = 0; i < 50; ++i) {
    const vec2 begin{place(random), place(random)}, end{place(random), place(random)};
    const float line_width = 1.0f + 0.2f * float(i % 20);
    const Grid<std::uint8_t> line = cpu::wide_line(begin, end, line_width, 40, 40);
    const vec2 along = glm::normalize(end - begin);
    const vec2 side = vec2(-along.y, along.x) * (0.5f * line_width);
    const Grid<std::uint8_t> polygon = cpu::polygon_fill(
        {{{begin + side, end + side, end - side, begin - side}}}, FillRule::even_odd, 40, 40);
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 40; ++x) {
        // The polygon's corners are floats up to 64 px.
        if (cpu::wide_line_border_distance(begin, end, line_width, {x + 0.5, y + 0.5}) <
            64.0 * 0x1p-22)
          continue;
        ++judged;
        EXPECT_EQ(line(x, y), polygon(x, y));
      }
  }
  EXPECT_GT(judged, 79900);
}

TEST(RasterReference, BorderDistancesOfAWideLine) {
  const auto distance = [](dvec2 p) {
    return cpu::wide_line_border_distance({0, 0}, {10, 0}, 4.0f, p);
  };
  EXPECT_EQ(distance({5, 0}), 2.0);
  EXPECT_EQ(distance({9, 0.5}), 1.0);
  EXPECT_EQ(distance({5, 3.5}), 1.5);
  EXPECT_EQ(distance({13, 6}), 5.0);
}

TEST(RasterReference, WideLinesOfNoLengthAndRefusedOnes) {
  EXPECT_EQ(covered(cpu::wide_line({3, 3}, {3, 3}, 2.0f, 8, 8)), 0);
  EXPECT_TRUE(cpu::wide_line({3, 3}, {5, 3}, 2.0f, 0, 0).empty());
  EXPECT_THROW(cpu::wide_line({3, 3}, {4, 3}, 0.0f, 8, 8), std::invalid_argument);
  EXPECT_THROW(cpu::wide_line({3, NAN}, {4, 3}, 1.0f, 8, 8), std::invalid_argument);
}

// Polygons

Polygon star(int points, int step, vec2 center, float radius) {
  Polygon polygon{{{}}};
  for (int i = 0; i < points; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i * step) / points - std::numbers::pi / 2.0;
    polygon.rings[0].push_back(center +
                               radius * vec2(float(std::cos(angle)), float(std::sin(angle))));
  }
  return polygon;
}

TEST(RasterReference, ThePentagramIsHollowByParityAndFullByWinding) {
  const Polygon pentagram = star(5, 2, {32.3f, 33.1f}, 30.0f);
  const auto even_odd = cpu::polygon_fill(pentagram, FillRule::even_odd, 64, 64);
  const auto non_zero = cpu::polygon_fill(pentagram, FillRule::non_zero, 64, 64);
  EXPECT_EQ(even_odd(32, 33), 0);
  EXPECT_EQ(non_zero(32, 33), 1);
  EXPECT_EQ(even_odd(32, 8), 1);  // in the upper point
  EXPECT_EQ(even_odd(2, 2), 0);
  // What differs is the inner pentagon: its circumradius is R / phi^2.
  const double inner_radius = 30.0 / (std::numbers::phi * std::numbers::phi);
  const double inner_area = 2.5 * inner_radius * inner_radius * std::sin(0.4 * std::numbers::pi);
  const double perimeter = 10.0 * inner_radius * std::sin(0.2 * std::numbers::pi);
  EXPECT_NEAR(covered(non_zero) - covered(even_odd), inner_area, perimeter / 2.0);
}

TEST(RasterReference, AHoleIsLeftOutByEitherRuleIfItRunsTheOtherWay) {
  const std::vector<vec2> square{{1, 1}, {9, 1}, {9, 9}, {1, 9}};
  const std::vector<vec2> hole{{3, 3}, {3, 7}, {7, 7}, {7, 3}};
  const std::vector<vec2> same_way{hole.rbegin(), hole.rend()};
  EXPECT_EQ(covered(cpu::polygon_fill({{square, hole}}, FillRule::even_odd, 10, 10)), 48);
  EXPECT_EQ(covered(cpu::polygon_fill({{square, hole}}, FillRule::non_zero, 10, 10)), 48);
  EXPECT_EQ(covered(cpu::polygon_fill({{square, same_way}}, FillRule::even_odd, 10, 10)), 48);
  EXPECT_EQ(covered(cpu::polygon_fill({{square, same_way}}, FillRule::non_zero, 10, 10)), 64);
}

// A jagged line from top to bottom parts a square: no pixel is lost, none is filled twice.
TEST(RasterReference, NeighbouringPolygonsFillEveryPixelOnce) {
  std::mt19937 random{4};
  std::uniform_int_distribution<int> half_pixel{10, 70};
  for (int i = 0; i < 100; ++i) {
    std::vector<vec2> left{{2.5f, 2.5f}}, right{{37.5f, 2.5f}};
    for (int k = 0; k <= 10; ++k) {  // corners and edges on pixel centres
      const vec2 p{0.5f * float(half_pixel(random)), 2.5f + 3.5f * float(k)};
      left.push_back(p);
      right.push_back(p);
    }
    left.push_back({2.5f, 37.5f});
    right.push_back({37.5f, 37.5f});
    const auto a = cpu::polygon_fill({{left}}, FillRule::even_odd, 40, 40);
    const auto b = cpu::polygon_fill({{right}}, FillRule::non_zero, 40, 40);
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 40; ++x)
        ASSERT_EQ(a(x, y) + b(x, y), x >= 2 && x < 37 && y >= 2 && y < 37) << x << " " << y;
  }
}

TEST(RasterReference, ATriangleAsAPolygonCoversWhatEdgeFunctionsCover) {
  std::mt19937 random{5};
  std::uniform_int_distribution<int> place{-64, 40 * 16};
  for (int i = 0; i < 500; ++i) {
    TriangleList list{
        .width = 32, .height = 32, .samples = 1, .clip_positions = {}, .triangles = {{0, 1, 2}}};
    Polygon polygon{{{}}};
    for (int k = 0; k < 3; ++k) {  // sixteenths of a pixel: exact in both
      const vec2 p = vec2(float(place(random)), float(place(random))) / 16.0f;
      polygon.rings[0].push_back(p);
      list.clip_positions.emplace_back(p / 16.0f - 1.0f, 0.5f, 1.0f);
    }
    const Coverage coverage = cpu::edge_coverage(list, Snapping::mesa);
    const auto filled = cpu::polygon_fill(polygon, FillRule::non_zero, 32, 32);
    for (std::size_t k = 0; k < filled.size(); ++k)
      ASSERT_EQ(filled.values()[k], coverage.count[k]);
  }
}

TEST(RasterReference, FilledPixelsTendToTheShoelaceArea) {
  std::mt19937 random{6};
  std::uniform_real_distribution<float> unit{0.3f, 1.0f};
  Polygon polygon = star(9, 1, {250.0f, 250.0f}, 240.0f);
  double area = 0.0, touched = 0.0;
  std::vector<vec2>& ring = polygon.rings[0];
  for (vec2& p : ring) p = vec2(250.0f) + (p - 250.0f) * unit(random);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const dvec2 a{ring[i]}, b{ring[(i + 1) % ring.size()]};
    area += 0.5 * (a.x * b.y - a.y * b.x);
    touched += std::abs(b.x - a.x) + std::abs(b.y - a.y) + 1.0;
  }
  // Only pixels that the border touches can differ, each by at most its area; they do so at random.
  EXPECT_NEAR(covered(cpu::polygon_fill(polygon, FillRule::non_zero, 500, 500)), area,
              4.0 * std::sqrt(touched / 12.0));
}

TEST(RasterReference, PolygonsWithNothingInThemAndRefusedOnes) {
  EXPECT_EQ(covered(cpu::polygon_fill({}, FillRule::even_odd, 4, 4)), 0);
  EXPECT_EQ(
      covered(cpu::polygon_fill({{{}, {{1, 1}}, {{0, 0}, {4, 4}}}}, FillRule::non_zero, 4, 4)), 0);
  EXPECT_THROW(cpu::polygon_fill({{{{0, 0}, {INFINITY, 0}, {0, 1}}}}, FillRule::even_odd, 4, 4),
               std::invalid_argument);
  // Far beyond the target, and larger than any integer.
  EXPECT_EQ(covered(cpu::polygon_fill({{{{-1e30f, -1e30f}, {1e30f, -1e30f}, {0, 1e30f}}}},
                                      FillRule::even_odd, 4, 4)),
            16);
}

}  // namespace
}  // namespace parity
