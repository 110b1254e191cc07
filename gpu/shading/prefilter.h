#pragma once

#include "geometry/environment.h"
#include "gpu/core/context.h"

namespace parity::gpu {

/// What renderers need of an environment: mirrors of seven roughnesses, and the irradiance by normal.
///
/// @param samples  directions for each texel of a rough mirror, 1 to 4096.
/// @throws std::invalid_argument  samples out of range, fewer than two levels.
///
/// Mathematics: cpu::prefilter.
EnvironmentLight prefilter(Context& context, const EnvironmentMap& map, int samples);

/// One mirror without its border.
Grid<vec4> prefilter_mirror(Context& context, const EnvironmentMap& map, double roughness, int side,
                            int samples);

/// EnvironmentLight::irradiance without its border.
Grid<vec4> prefilter_irradiance(Context& context, const EnvironmentMap& map);

/// Irradiance over pi as nine polynomials of the normal.
std::array<vec3, 9> project_irradiance(Context& context, const EnvironmentMap& map);

}  // namespace parity::gpu
