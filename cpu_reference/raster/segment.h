#pragma once

#include <span>

#include "geometry/raster.h"

namespace parity::cpu {

/// @throws std::invalid_argument  a coordinate beyond +-2^20.
void check_segments(std::span<const Segment> segments);

}  // namespace parity::cpu
