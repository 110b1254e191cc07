#pragma once

#include <span>
#include <vector>

#include "geometry/transform.h"

namespace parity::cpu {

/// Rotation by `angle` rad about `axis` (normalised first): (cos(angle/2), sin(angle/2) axis).
///
/// @throws std::invalid_argument  the axis is zero or not finite.
///
/// Source: notes 2.7.
dquat quaternion_from_axis_angle(dvec3 axis, double angle);

/// q / |q|.
///
/// @throws std::invalid_argument  the quaternion is zero or not finite.
dquat quaternion_normalize(dquat q);

/// The product second * first: the rotation `first` followed by `second`.
///
/// Source: notes 2.7.
dquat quaternion_compose(dquat second, dquat first);

/// conj(q) / |q|^2.
///
/// @throws std::invalid_argument  the quaternion is zero or not finite.
///
/// Source: notes 2.7.
dquat quaternion_inverse(dquat q);

/// q v q^-1; any q but 0.
///
/// Source: notes 2.7.
dvec3 quaternion_rotate(dquat q, dvec3 v);

/// R = I + 2 s [v]x + 2 [v]x^2 of a unit quaternion (s, v).
///
/// Source: notes 2.7.
dmat3 quaternion_matrix(dquat unit);

/// The matrix of each quaternion, as it stands: not normalised.
std::vector<dmat3> quaternion_matrix(std::span<const quat> units);

/// Vector i turned by quaternion i.
///
/// @throws std::invalid_argument  the counts differ, or a quaternion is zero.
std::vector<dvec3> quaternion_rotate(std::span<const quat> quaternions,
                                     std::span<const vec3> vectors);

}  // namespace parity::cpu
