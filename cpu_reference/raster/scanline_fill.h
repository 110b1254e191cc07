#pragma once

#include "geometry/raster.h"

namespace parity::cpu {

/// What covers every sample, row by row: the two edges that cross a row of samples are intersected
/// with it, and the span between is filled. Exact: crossings are fractions of integers.
///
/// A row y crosses an edge if y_low <= y < y_high, and the span is [ceil(x_left), ceil(x_right)):
/// half open, which is the top-left rule. Equals edge_coverage.
///
/// @throws std::invalid_argument  as check_triangles.
///
/// Source: notes 1.5, which leave the ends of the spans open.
Coverage scanline_fill(const TriangleList& list, Snapping snapping);

}  // namespace parity::cpu
