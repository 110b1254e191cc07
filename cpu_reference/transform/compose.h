#pragma once

#include <span>
#include <vector>

#include "geometry/transform.h"

namespace parity::cpu {

/// Translation by `offset`, m. Moves points (w = 1), leaves vectors (w = 0) alone.
///
/// Source: notes 2.1.
dmat4 translation(dvec3 offset);

/// Rotation by a quaternion, unit up to rounding (it is normalised).
///
/// @throws std::invalid_argument  the quaternion is zero.
///
/// Source: notes 2.7.
dmat4 rotation(dquat unit);

/// Scale along the axes.
dmat4 scaling(dvec3 factors);

/// Translation after rotation after scale, one matrix a Trs: M = T R S, read right to left.
///
/// @throws std::invalid_argument  a rotation is the zero quaternion.
///
/// Source: notes 2.4.
std::vector<dmat4> compose(std::span<const Trs> transforms);

/// 2D transforms as 3x3 homogeneous matrices: rotation by `angle` (rad, counter-clockwise), scale,
/// and the shear (x, y) -> (x + a_x y, y + a_y x).
///
/// Source: notes 2.2.
dmat3 rotation_2d(double angle);
dmat3 scaling_2d(dvec2 factors);
dmat3 shear_2d(dvec2 amounts);
dmat3 translation_2d(dvec2 offset);

/// The same transform with `center` in the place of the origin: T(center) M T(-center).
///
/// Source: notes 2.2.
dmat3 about_point(const dmat3& transform, dvec2 center);

}  // namespace parity::cpu
