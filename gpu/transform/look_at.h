#pragma once

#include <span>
#include <vector>

#include "geometry/transform.h"
#include "gpu/core/context.h"

namespace parity::gpu {

/// View from world: the eye at the origin, the centre on -z, up in the plane x = 0, y > 0.
///
/// @throws std::invalid_argument  eye and center are one point, or up is parallel to the view.
///
/// Mathematics: notes 2.5.
std::vector<mat4> look_at(Context& context, std::span<const LookAt> cameras);

}  // namespace parity::gpu
