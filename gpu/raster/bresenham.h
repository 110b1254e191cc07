#pragma once

#include <span>
#include <vector>

#include "geometry/raster.h"
#include "gpu/core/context.h"

namespace parity::gpu {

/// The pixels of each segment from its begin to its end: one for each step of the longer side, the
/// shorter coordinate within half a pixel of the line. In integers.
///
/// @param segments  coordinates within +-2^20, sides of at most 60,000 pixels (the loop of a
/// thread).
/// @throws std::invalid_argument  a coordinate or a side is beyond that.
///
/// Source: notes 1.9; Bresenham 1965. Erratum: the notes' error term neither starts half way nor is
/// reduced by the longer side. A tie goes to the coordinate nearer to the begin.
std::vector<std::vector<ivec2>> bresenham(Context& context, std::span<const Segment> segments);

}  // namespace parity::gpu
