#include "cpu_reference/raster/bresenham.h"

#include <cstdlib>

#include "cpu_reference/raster/segment.h"

namespace parity::cpu {
namespace {

std::vector<ivec2> line(Segment segment) {
  const ivec2 delta = segment.end - segment.begin;
  const bool steep = std::abs(delta.y) > std::abs(delta.x);
  const int major = steep ? 1 : 0;
  const int minor = 1 - major;
  const int major_step = delta[major] < 0 ? -1 : 1;
  const int minor_step = delta[minor] < 0 ? -1 : 1;
  const int length = std::abs(delta[major]);
  const int rise = std::abs(delta[minor]);

  std::vector<ivec2> pixels;
  pixels.reserve(std::size_t(length) + 1);
  ivec2 pixel = segment.begin;
  int error = 2 * rise - length;
  for (int i = 0; i <= length; ++i) {
    pixels.push_back(pixel);
    if (error > 0) {
      pixel[minor] += minor_step;
      error -= 2 * length;
    }
    error += 2 * rise;
    pixel[major] += major_step;
  }
  return pixels;
}

}  // namespace

std::vector<std::vector<ivec2>> bresenham(std::span<const Segment> segments) {
  check_segments(segments);
  std::vector<std::vector<ivec2>> lines;
  lines.reserve(segments.size());
  for (const Segment& segment : segments) lines.push_back(line(segment));
  return lines;
}

}  // namespace parity::cpu
