#pragma once

#include "geometry/raster.h"
#include "shaders/raster/layout.h"

namespace parity::gpu {

/// What the kernels must know of a picture. The guard band leaves 32766 pixels between any two
/// corners, which keeps all that a tile adds up within 32 bits (raster/edge.glsl).
RasterTarget raster_target(int width, int height, int samples, Snapping snapping);

}  // namespace parity::gpu
