#pragma once

#include <span>
#include <vector>

#include "geometry/camera.h"
#include "geometry/transform.h"
#include "gpu/core/context.h"

namespace parity::gpu {

/// Clip from view of a box for Vulkan: y down, depth 0 at near and 1 at far, reverse-Z 1 and 0.
///
/// @throws std::invalid_argument  near and far are equal or not finite, or a side of no length.
///
/// Mathematics: notes 2.6 (the formula is theirs by name only).
std::vector<mat4> orthographic(Context& context, std::span<const ViewVolume> volumes,
                               DepthMode depth);

}  // namespace parity::gpu
