#pragma once

#include <array>
#include <vector>

#include "geometry/raster.h"

namespace parity::cpu {

/// The part of a triangle inside the view volume, widened to a guard band in x and y:
/// w >= the smallest normal float, 0 <= z <= w, |x| <= g w, |y| <= g w.
///
/// Points of intersection are computed from the inside to the outside, in the order of the planes
/// w, near, far, left, right, top, bottom: two triangles get the same point on their common edge.
///
/// @param guard_band  g >= 1, in half sizes of the viewport.
///
/// Source: notes 1.1 (which leave clipping out); Sutherland & Hodgman 1974; Blinn & Newell 1978.
ClippedPolygon clip_triangle(const std::array<dvec4, 3>& corners, double guard_band);

/// Every triangle of the list, clipped; in the order of the list.
///
/// @throws std::invalid_argument  guard_band < 1, or an index out of range.
std::vector<ClippedPolygon> clip(const TriangleList& list, double guard_band);

}  // namespace parity::cpu
