#pragma once

#include "geometry/grid.h"
#include "geometry/raster.h"
#include "gpu/core/context.h"

namespace parity::gpu {

/// The area of a polygon within each pixel, as the sum over its edges of what lies left of them.
///
/// @throws std::invalid_argument  a size outside 1..16384, or a corner that is no number or outside
///                                +-65536.
///
/// Mathematics: cpu::area_coverage. Precision: area_coverage_bound.
Grid<float> area_coverage(Context& context, const Polygon& polygon, int width, int height);

/// How far it may be from the exact area: each edge is moved by the rounding of its corners
/// relative to the pixel and of the crossing, 6 2^-24 of the largest coordinate, over a height of 1
/// px; sums of `edges` terms add 2^-24 each.
double area_coverage_bound(const Polygon& polygon, int width, int height);

}  // namespace parity::gpu
