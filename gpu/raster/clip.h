#pragma once

#include <vector>

#include "geometry/raster.h"
#include "gpu/core/context.h"

namespace parity::gpu {

/// What the planes w = 1e-30, z = 0, z = w and |x|, |y| = guard_band w leave of each triangle.
///
/// @param guard_band  at least 1: what is between the view and the guard band is left alone.
/// @throws std::invalid_argument  guard_band below 1, an index out of range, a size
/// outside 1..16384.
///
/// Mathematics: notes 1.1; Sutherland & Hodgman 1974. In float, one rounding an operation: a corner
/// moves by at most 8 x 2^-24 of its triangle's size for each plane that cuts.
std::vector<ClippedPolygon> clip(Context& context, const TriangleList& list, float guard_band);

}  // namespace parity::gpu
