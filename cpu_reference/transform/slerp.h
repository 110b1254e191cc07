#pragma once

#include <span>
#include <vector>

#include "geometry/transform.h"

namespace parity::cpu {

/// Spherical interpolation of unit quaternions along the shorter arc, at constant angular speed.
/// The answers are unit; the ends are met up to rounding and sign.
///
/// @throws std::invalid_argument  a quaternion is zero or not finite.
///
/// Source: notes 2.7; Shoemake 1985.
/// Erratum: the notes call their formula the shortest arc, but q and -q are one rotation: where the
/// dot product is negative they turn the long way. One pose is negated first. Where sin(Omega)
/// vanishes, the formula's limit, normalised linear interpolation, takes over.
std::vector<dquat> slerp(std::span<const SlerpProblem> problems);

/// Normalised linear interpolation along the shorter arc: slerp's path, but not its speed.
///
/// @throws std::invalid_argument  a quaternion is zero or not finite.
std::vector<dquat> nlerp(std::span<const SlerpProblem> problems);

}  // namespace parity::cpu
