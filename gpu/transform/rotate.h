#pragma once

#include <span>
#include <vector>

#include "geometry/transform.h"
#include "gpu/core/context.h"

namespace parity::gpu {

/// Rotations about unit axes, counter-clockwise seen from the tip of the axis.
///
/// @throws std::invalid_argument  an angle is beyond 8192 rad, or not finite.
///
/// Mathematics: notes 2.3 (Rodrigues). Accuracy: 2^-21 with a sine and cosine of our own.
std::vector<mat3> rotate(Context& context, std::span<const AxisAngle> rotations);

}  // namespace parity::gpu
