#pragma once

#include <cstdint>

#include "geometry/raster.h"
#include "gpu/core/context.h"

namespace parity::gpu {

/// 1 where the centre of a pixel is inside the polygon. Rings close themselves; a centre on a left
/// or top side is inside, on a right or bottom side outside, so that polygons side by side cover
/// each pixel once.
///
/// @param polygon  finite coordinates within 2^24, at most 60,000 sides (the loop of a thread).
/// @throws std::invalid_argument  a coordinate or the number of sides is beyond that, or a size is
///                                not 1 to 16384.
///
/// Mathematics: notes 1.9, by crossings of the row. Sides of points are decided in two-float
/// arithmetic: exact but for 2^-44.
Grid<std::uint8_t> polygon_fill(Context& context, const Polygon& polygon, FillRule rule, int width,
                                int height);

}  // namespace parity::gpu
