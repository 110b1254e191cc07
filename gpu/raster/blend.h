#pragma once

#include <vector>

#include "geometry/raster.h"
#include "gpu/core/context.h"
#include "gpu/core/image.h"

namespace parity::gpu {

/// Layers on top of each other, the first at the bottom, on (0, 0, 0, 0).
///
/// @param layers  one or more, of one size; colours and alpha in 0..1 for `over`.
/// @throws std::invalid_argument  no layers, or sizes differ.
///
/// Mathematics: notes 1.7; Porter & Duff 1984. In float, without clamping.
Grid<vec4> blend(Context& context, const std::vector<Grid<vec4>>& layers, BlendMode mode);

/// The same through the device's blender into a target of `format`, which rounds after each layer.
///
/// @param format  rgba8, rgba8_srgb, rgba16_float or rgba32_float.
/// @throws Error  the device cannot blend that format.
Grid<vec4> hardware_blend(Context& context, const std::vector<Grid<vec4>>& layers, BlendMode mode,
                          Format format);

}  // namespace parity::gpu
