#pragma once

#include <span>
#include <vector>

#include "geometry/raster.h"

namespace parity::cpu {

/// The pixels of each segment from begin to end, both included, by adding (dx, dy) / n at each of
/// n = max(|dx|, |dy|) steps and rounding, floor(v + 1/2). Float in this order, because a decision
/// depends on it: the pixel is the nearest to the ideal line, but for ties and a drift of at most
/// n 2^-24 (|begin| + n + 1) px.
///
/// @throws std::invalid_argument  a coordinate beyond +-2^20.
///
/// Source: notes 1.9.
std::vector<std::vector<ivec2>> dda_line(std::span<const Segment> segments);

}  // namespace parity::cpu
