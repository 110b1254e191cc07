#pragma once

#include "geometry/raster.h"
#include "gpu/core/context.h"

namespace parity::gpu {

/// The samples that edge_coverage covers, found span by span: each row of samples is filled between
/// the left and the right edges that cross it, half open.
///
/// @throws std::invalid_argument  an index out of range, a size outside 1..16384, samples not 1, 2,
///                                4 or 8.
///
/// Mathematics: notes 1.5, with the half-open spans [ceil(xl - 1/2), ceil(xr - 1/2)) that they
/// leave out. Borders are decided in integers.
Coverage scanline_fill(Context& context, const TriangleList& list, Snapping snapping);

}  // namespace parity::gpu
