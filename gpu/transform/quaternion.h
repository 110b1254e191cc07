#pragma once

#include <span>
#include <vector>

#include "geometry/transform.h"
#include "gpu/core/context.h"

namespace parity::gpu {

/// (x, y, z, w), w real: as the kernels hold quaternions.
vec4 quaternion_components(const quat& q);

/// Rotation matrices of unit quaternions. Mathematics: notes 2.7. Accuracy: 4 x 2^-24.
std::vector<mat3> quaternion_matrix(Context& context, std::span<const quat> quaternions);

/// q v q^-1 for each pair of a unit quaternion and a vector.
///
/// @throws std::invalid_argument  the numbers of quaternions and vectors differ.
///
/// Mathematics: notes 2.7.
std::vector<vec3> quaternion_rotate(Context& context, std::span<const quat> quaternions,
                                    std::span<const vec3> vectors);

}  // namespace parity::gpu
