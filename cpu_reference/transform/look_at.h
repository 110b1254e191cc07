#pragma once

#include <span>
#include <vector>

#include "geometry/transform.h"

namespace parity::cpu {

/// View from world of a camera at `eye` that looks at `center` along -z, with `up` upwards: a
/// rotation and a translation, determinant +1, right-handed. One matrix a camera.
///
/// @throws std::invalid_argument  eye and center coincide, or the gaze is parallel to up, or a
///                                number is not finite.
///
/// Source: notes 2.5. In the notes w is the right axis, t the upper one and g the gaze.
std::vector<dmat4> look_at(std::span<const LookAt> cameras);

}  // namespace parity::cpu
