#pragma once

#include <cstdlib>
#include <functional>
#include <vector>

#include "geometry/raster.h"

namespace parity {

using DrawLine = std::function<std::vector<ivec2>(const Segment&)>;

/// Is this the line of nearest pixels: it starts at begin, ends at end, has one pixel for each step
/// of the longer axis, and none is more than half a pixel off the ideal line? In integers.
inline bool is_line_of_nearest_pixels(const Segment& segment, const std::vector<ivec2>& pixels) {
  const ivec2 d = segment.end - segment.begin;
  const int major = std::abs(d.y) > std::abs(d.x) ? 1 : 0;
  const std::int64_t length = std::abs(d[major]);
  if (std::int64_t(pixels.size()) != length + 1) return false;
  if (pixels.front() != segment.begin || pixels.back() != segment.end) return false;
  for (std::int64_t i = 0; i <= length; ++i) {
    const ivec2 p = pixels[std::size_t(i)] - segment.begin;
    if (std::abs(p[major]) != i || std::int64_t(p[major]) * d[major] < 0) return false;
    // minor - i d_minor / length, times 2 length
    const std::int64_t off = 2 * (p[1 - major] * length - i * d[1 - major]);
    if (std::abs(off) > length) return false;
  }
  return true;
}

/// Does a line algorithm draw nearest pixels over all segments from the origin within +-12?
/// Checklist row 22.
inline bool draws_nearest_pixels(const DrawLine& draw) {
  for (int y = -12; y <= 12; ++y)
    for (int x = -12; x <= 12; ++x) {
      const Segment segment{{3, -5}, {3 + x, -5 + y}};
      if (!is_line_of_nearest_pixels(segment, draw(segment))) return false;
    }
  return true;
}

}  // namespace parity
