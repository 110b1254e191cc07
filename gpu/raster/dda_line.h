#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/raster.h"
#include "gpu/core/context.h"

namespace parity::gpu {

/// The pixels of each segment, found by adding the slope in float and rounding half up. The sum
/// drifts by at most n^2 2^-25 pixel over n steps.
///
/// @param segments  as bresenham.
///
/// Source: notes 1.9.
std::vector<std::vector<ivec2>> dda_line(Context& context, std::span<const Segment> segments);

}  // namespace parity::gpu
