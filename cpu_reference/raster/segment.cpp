#include "cpu_reference/raster/segment.h"

#include <stdexcept>
#include <string>

namespace parity::cpu {

void check_segments(std::span<const Segment> segments) {
  constexpr int limit = 1 << 20;
  for (const Segment& segment : segments)
    for (const int coordinate : {segment.begin.x, segment.begin.y, segment.end.x, segment.end.y})
      if (coordinate < -limit || coordinate > limit)
        throw std::invalid_argument("Segment: a coordinate is " + std::to_string(coordinate) +
                                    ", must be within +-2^20");
}

}  // namespace parity::cpu
