#pragma once

#include "geometry/raster.h"
#include "gpu/core/context.h"

namespace parity::gpu {

/// The varying of the last triangle that covers each pixel's centre; 0 where none does. One sample
/// a pixel, whatever the list says.
///
/// @throws std::invalid_argument  not one value a clip position, an index out of range, a size
///                                outside 1..16384.
///
/// Mathematics: notes 1.3, 1.6; Olano & Greer 1997: barycentric coordinates from clip positions,
/// not snapped. Accuracy: as if each corner were moved by 2^-23 of the window.
Grid<vec4> interpolate(Context& context, const TriangleList& list, const Varyings& varyings,
                       Snapping snapping);

/// The same through the device's fixed-function pipeline.
Grid<vec4> hardware_interpolate(Context& context, const TriangleList& list,
                                const Varyings& varyings);

}  // namespace parity::gpu
