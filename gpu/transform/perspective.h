#pragma once

#include <span>
#include <vector>

#include "geometry/camera.h"
#include "geometry/transform.h"
#include "gpu/core/context.h"

namespace parity::gpu {

/// Clip from view of a frustum for Vulkan: y down, depth 0 at near and 1 at far, reverse-Z 1 and 0;
/// logarithmic depth uses the standard matrix.
///
/// @throws std::invalid_argument  not 0 < near < far (far may be infinite), or a side of no length.
///
/// Mathematics: notes 2.6. Erratum: the notes' squeeze matrix has w' = +z; w' is -z.
std::vector<mat4> perspective(Context& context, std::span<const ViewVolume> volumes,
                              DepthMode depth);

}  // namespace parity::gpu
