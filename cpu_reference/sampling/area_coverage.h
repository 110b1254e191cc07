#pragma once

#include "geometry/grid.h"
#include "geometry/raster.h"

namespace parity::cpu {

/// The area of a polygon within each pixel: what infinitely many samples would count. Rings that
/// are clockwise on the screen (y down) count positive, others negative; where rings overlap, areas
/// add.
///
/// @return  width x height areas in px^2; their sum is the polygon's area within the picture.
/// @throws std::invalid_argument  a size outside 1..16384.
///
/// Source: notes 1.8 (the limit of SSAA); Sutherland & Hodgman 1974; Catmull 1978.
Grid<double> area_coverage(const Polygon& polygon, int width, int height);

}  // namespace parity::cpu
