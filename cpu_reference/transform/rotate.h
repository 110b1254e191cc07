#pragma once

#include <span>
#include <vector>

#include "geometry/transform.h"

namespace parity::cpu {

/// Rotation about a coordinate axis by `angle` rad, counter-clockwise seen from its tip.
///
/// Source: notes 2.3.
dmat3 rotation_x(double angle);
dmat3 rotation_y(double angle);
dmat3 rotation_z(double angle);

/// Rotation about a unit axis: R = I cos + [k]x sin + k k^T (1 - cos), one matrix a pair. The axis
/// is normalised first.
///
/// @throws std::invalid_argument  an axis is zero or not finite.
///
/// Source: notes 2.3 (Rodrigues).
std::vector<dmat3> rotate(std::span<const AxisAngle> rotations);

/// The vector turned about a unit axis: v cos + (k x v) sin + k (k.v) (1 - cos).
///
/// Source: notes 2.3 (Rodrigues).
dvec3 rodrigues(dvec3 vector, dvec3 axis, double angle);

}  // namespace parity::cpu
