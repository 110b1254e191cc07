#pragma once

#include "geometry/raster.h"
#include "gpu/core/context.h"

namespace parity::gpu {

/// What covers each sample, by exact integer edge functions with the top-left rule, through the
/// TileRasterizer. Triangles are clipped by the near and far planes, and where they are further
/// than 16383 pixels from the middle of the picture.
///
/// @throws std::invalid_argument  an index out of range, a size outside 1..16384, samples not 1, 2,
///                                4 or 8.
///
/// Mathematics: notes 1.4, 1.5.
Coverage edge_coverage(Context& context, const TriangleList& list, Snapping snapping);

/// The same through the device's fixed-function pipeline.
///
/// @throws Error  the device lacks that number of samples (1 and 4 are always there).
Coverage hardware_coverage(Context& context, const TriangleList& list);

}  // namespace parity::gpu
