#pragma once

#include "geometry/camera.h"
#include "geometry/raster.h"
#include "gpu/core/context.h"

namespace parity::gpu {

/// What is in front at each pixel's centre, and its depth (32-bit float), through the
/// TileRasterizer; of equal depths the first triangle. One sample a pixel, whatever the list says.
///
/// @param near, far  m, for DepthMode::logarithmic: depth is log2(w / near) / log2(far / near).
/// @throws std::invalid_argument  an index out of range, a size outside 1..16384, near and far not
///                                0 < near < far where they are used.
///
/// Mathematics: notes 1.7. Erratum: notes 1.3 correct depth for perspective; z/w is affine in the
/// window already. Logarithmic depth is not: it is taken from 1/w at each pixel.
DepthImage depth_test(Context& context, const TriangleList& list, DepthMode mode, float near,
                      float far, Snapping snapping);

/// The same through the device's fixed-function pipeline; logarithmic depth is written by the
/// fragment.
DepthImage hardware_depth_test(Context& context, const TriangleList& list, DepthMode mode,
                               float near, float far);

}  // namespace parity::gpu
