// The device's lines against mathematics, and against those of its fixed function.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/random.h"
#include "gpu/core/error.h"
#include "gpu/raster/bresenham.h"
#include "gpu/raster/dda_line.h"
#include "gpu/raster/wide_line.h"
#include "tests/gpu_context.h"

namespace parity {
namespace {

TEST(GpuLines, StayWithinHalfAPixelInAllOctants) {
  std::vector<Segment> segments{{{5, 5}, {5, 5}}};
  for (int y = -9; y <= 9; ++y)
    for (int x = -9; x <= 9; ++x) segments.push_back({{3, -2}, {3 + 2 * x, -2 + 3 * y}});
  const auto bresenham = gpu::bresenham(test_context(), segments);
  const auto dda = gpu::dda_line(test_context(), segments);
  for (std::size_t i = 0; i < segments.size(); ++i)
    for (const std::vector<ivec2>& line : {bresenham[i], dda[i]}) {
      const ivec2 d = segments[i].end - segments[i].begin;
      const int steps = std::max(std::abs(d.x), std::abs(d.y));
      ASSERT_EQ(line.size(), std::size_t(steps) + 1);
      EXPECT_EQ(line.front(), segments[i].begin);
      EXPECT_EQ(line.back(), segments[i].end);
      for (int k = 0; k <= steps && steps > 0; ++k) {
        const dvec2 ideal = dvec2(segments[i].begin) + dvec2(d) * (double(k) / steps);
        const dvec2 off = glm::abs(dvec2(line[std::size_t(k)]) - ideal);
        EXPECT_LE(std::max(off.x, off.y), 0.5 + 1e-5);
      }
    }
  const std::vector<Segment> long_line{{{0, 0}, {70000, 1}}};
  EXPECT_THROW(gpu::bresenham(test_context(), long_line), std::invalid_argument);
}

// Fixed point moves corners by up to half a unit in x and y: centres further than sqrt(2) units
// from the border of the rectangle are decided.
TEST(GpuLines, AreRectanglesOnTheDeviceToo) {
  const vec2 begin(3.3f, 4.6f), end(40.2f, 17.9f);
  const Grid<std::uint8_t> hardware =
      gpu::hardware_line(test_context(), begin, end, gpu::LineRule::any, {48, 24});
  const Grid<std::uint8_t> compute = gpu::wide_line(test_context(), begin, end, 1, {48, 24});
  const dvec2 along = glm::normalize(dvec2(end - begin));
  const double length = glm::length(dvec2(end - begin));
  const double margin = std::sqrt(2.0) / (1 << std::min(8, test_context().info().subpixel_bits));
  int judged = 0;
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 48; ++x) {
      const dvec2 p = dvec2(x + 0.5, y + 0.5) - dvec2(begin);
      const double s = glm::dot(p, along), t = p.x * along.y - p.y * along.x;
      const double inside = std::min({s, length - s, 0.5 - std::abs(t)});
      if (std::abs(inside) < margin) continue;
      ++judged;
      EXPECT_EQ(int(hardware(x, y)), inside > 0 ? 1 : 0) << x << ", " << y;
      EXPECT_EQ(int(compute(x, y)), inside > 0 ? 1 : 0) << x << ", " << y;
    }
  EXPECT_GT(judged, 1000);
}

/// Pixels of the device's line that are not those of ours, but for ties, where either of two is
/// nearest, and for the ends: a line leaves out the one in whose diamond it ends, so that lines
/// which meet there do not draw it twice; Vulkan grants one pixel more or less.
///
/// @param off  how far a pixel may be from ours across the line; Vulkan grants 1.
std::size_t wrong_pixels(const Segment& segment, const std::vector<ivec2>& pixels,
                         Grid<std::uint8_t> hardware, int off) {
  const ivec2 d = segment.end - segment.begin;
  const int major = std::abs(d.y) > std::abs(d.x) ? 1 : 0;
  const int steps = std::abs(d[major]), rise = std::abs(d[1 - major]);
  const int side = d[1 - major] > 0 ? 1 : -1;
  std::size_t wrong = 0, left_out = 0;
  for (int k = 0; k <= steps; ++k) {
    const bool tie = 2 * k * rise % (2 * steps) == steps;
    int seen = 0;
    for (int across = -off; across <= std::max(off, int(tie)); ++across) {
      ivec2 pixel = pixels[std::size_t(k)];
      pixel[1 - major] += side * across;
      std::uint8_t& covered = hardware(pixel.x, pixel.y);
      seen += covered;
      covered = 0;
    }
    const bool is_left_out = seen == 0 && (k == 0 || k == steps);
    left_out += is_left_out;
    wrong += seen != 1 && !is_left_out;
  }
  if (left_out == 0) ++wrong;
  return wrong + std::size_t(std::count(hardware.begin(), hardware.end(), 1));
}

TEST(GpuLines, OfBresenhamAreThoseOfTheDevice) {
  constexpr int side = 64;
  Random random{4};
  std::vector<Segment> segments;
  for (int i = 0; i < 60; ++i) {
    const auto point = [&] {
      return ivec2(1 + random.below(side - 2), 1 + random.below(side - 2));
    };
    segments.push_back({point(), point()});
  }
  for (const ivec2 d : {ivec2(20, 0), {-20, 0}, {0, 20}, {0, -20}, {20, 20}, {-20, 20}, {20, -10}})
    segments.push_back({ivec2(30), ivec2(30) + d});
  const auto ours = gpu::bresenham(test_context(), segments);
  const int off = test_context().info().is_mesa_software ? 0 : 1;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const vec2 begin = vec2(segments[i].begin) + 0.5f, end = vec2(segments[i].end) + 0.5f;
    try {
      const Grid<std::uint8_t> hardware =
          gpu::hardware_line(test_context(), begin, end, gpu::LineRule::bresenham, ivec2(side));
      EXPECT_EQ(wrong_pixels(segments[i], ours[i], hardware, off), 0u) << "segment " << i;
    } catch (const gpu::Error& error) {
      GTEST_SKIP() << "skipped: " << error.what();
    }
  }
}

}  // namespace
}  // namespace parity
