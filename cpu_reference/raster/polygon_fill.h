#pragma once

#include <cstdint>

#include "geometry/raster.h"

namespace parity::cpu {

/// The pixels whose centre is inside a polygon: a ray to the left crosses its edges an odd number
/// of times (even_odd), or winds around (non_zero). 1 inside, 0 outside.
///
/// Half open: an edge is crossed in rows y_low <= y < y_high, so that corners count once and
/// horizontal edges never; a centre on an edge lies to its right. So neighbours that share an edge
/// fill every pixel once. Rings close by themselves; those of fewer than 3 points fill nothing.
///
/// @param polygon  px, y down; exact while coordinates are multiples of 2^-8 within +-2^14.
/// @throws std::invalid_argument  a coordinate is not finite.
///
/// Source: notes 1.9, which leave corners, horizontal edges and the rule open.
Grid<std::uint8_t> polygon_fill(const Polygon& polygon, FillRule rule, int width, int height);

}  // namespace parity::cpu
