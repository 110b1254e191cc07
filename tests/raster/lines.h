#pragma once

#include <vector>

#include "geometry/random.h"
#include "geometry/raster.h"
#include "tests/setting.h"

/// Segments in all octants, for the records of line stages.
namespace parity::raster_test {

using Lines = std::vector<std::vector<ivec2>>;

/// How many segments, and how far they reach.
inline std::vector<Axis> line_axes() {
  return {{.name = "count",
           .low = 1,
           .high = 1031,
           .standard = 131,
           .logarithmic = true,
           .whole = true},
          {.name = "reach",
           .unit = "px",
           .low = 1,
           .high = 500,
           .standard = 50,
           .logarithmic = true,
           .whole = true}};
}

/// Random segments up to `reach` px from the origin; every fifth is axis-aligned, diagonal or a
/// point.
inline std::vector<Segment> random_segments(const Setting& setting) {
  Random random{setting.seed};
  const auto reach = std::uint32_t(setting.count("reach"));
  const auto coordinate = [&] { return int(random.below(2 * reach + 1)) - int(reach); };
  std::vector<Segment> segments(std::size_t(setting.count("count")));
  for (std::size_t i = 0; i < segments.size(); ++i) {
    Segment& s = segments[i];
    s.begin = {coordinate(), coordinate()};
    s.end = {coordinate(), coordinate()};
    if (i % 5 != 4) continue;
    const int length = coordinate();
    const ivec2 ways[] = {{length, 0}, {0, length}, {length, length}, {length, -length}, {0, 0}};
    s.end = s.begin + ways[i / 5 % 5];
  }
  return segments;
}

}  // namespace parity::raster_test
