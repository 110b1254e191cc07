#pragma once

#include <span>
#include <vector>

#include "gpu/core/context.h"
#include "shaders/shading/layout.h"

namespace parity::gpu {

/// Irradiance of rectangles on surfaces. Mathematics: cpu::rectangle_light. The device's arc
/// tangent may be off by 4096 ULP.
std::vector<float> rectangle_light(Context& context, std::span<const RectangleQuery> queries);

/// What rough mirrors show of spheres. Mathematics: cpu::sphere_light.
std::vector<float> sphere_light(Context& context, std::span<const SphereQuery> queries);

}  // namespace parity::gpu
