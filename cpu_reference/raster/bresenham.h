#pragma once

#include <span>
#include <vector>

#include "geometry/raster.h"

namespace parity::cpu {

/// The pixels of each segment from begin to end, both included: one a column (row, if steep), the
/// nearest to the ideal line. Integers only, all eight octants. Of two pixels as near, the one on
/// the side of the segment's begin is taken: the step is delayed.
///
/// @throws std::invalid_argument  a coordinate beyond +-2^20.
///
/// Source: notes 1.9; Bresenham 1965.
/// Erratum: the notes' error term e += dy, step if e > dx, is never reset and lacks the half: it
/// strays up to a pixel (or for ever) and does not reach the end. Right is D = 2 dy - dx; at each
/// step: if D > 0 { y += 1; D -= 2 dx }; D += 2 dy.
std::vector<std::vector<ivec2>> bresenham(std::span<const Segment> segments);

}  // namespace parity::cpu
