#pragma once

#include <span>
#include <vector>

#include "geometry/math.h"
#include "geometry/projection.h"
#include "gpu/core/context.h"

namespace parity::gpu {

/// (u, v, face) of points. Mathematics: cpu::project. Float: angles are off by 2^-22 of themselves.
std::vector<vec3> project(Context& context, Projection projection, std::span<const vec3> points);

/// Mathematics: cpu::triplanar_weights.
std::vector<vec3> triplanar_weights(Context& context, std::span<const vec3> normals);

}  // namespace parity::gpu
