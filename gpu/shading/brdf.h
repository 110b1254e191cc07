#pragma once

#include <span>
#include <vector>

#include "geometry/grid.h"
#include "geometry/math.h"
#include "gpu/core/context.h"
#include "shaders/shading/layout.h"

namespace parity::gpu {

/// Values of BRDFs, 1/sr.
///
/// @param queries  unit directions, alpha > 0.
/// @param albedo   the table of albedo_table, read by brdf_ggx_multi_scatter only.
///
/// Mathematics: cpu::brdf. The error function in Beckmann's shadowing is that of Abramowitz &
/// Stegun 7.1.26, right to 1.5e-7.
std::vector<vec3> brdf(Context& context, std::span<const BrdfQuery> queries,
                       const Grid<vec4>& albedo);

}  // namespace parity::gpu
