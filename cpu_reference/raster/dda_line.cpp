#include "cpu_reference/raster/dda_line.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "cpu_reference/raster/segment.h"

namespace parity::cpu {
namespace {

std::vector<ivec2> line(Segment segment) {
  const ivec2 delta = segment.end - segment.begin;
  const int steps = std::max(std::abs(delta.x), std::abs(delta.y));
  std::vector<ivec2> pixels{segment.begin};
  pixels.reserve(std::size_t(steps) + 1);
  const vec2 step = vec2(delta) / float(std::max(steps, 1));
  vec2 position{segment.begin};
  for (int i = 0; i < steps; ++i) {
    position += step;
    pixels.emplace_back(glm::floor(position + 0.5f));
  }
  return pixels;
}

}  // namespace

std::vector<std::vector<ivec2>> dda_line(std::span<const Segment> segments) {
  check_segments(segments);
  std::vector<std::vector<ivec2>> lines;
  lines.reserve(segments.size());
  for (const Segment& segment : segments) lines.push_back(line(segment));
  return lines;
}

}  // namespace parity::cpu
