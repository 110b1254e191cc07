#pragma once

#include <span>
#include <vector>

#include "geometry/grid.h"
#include "geometry/math.h"
#include "gpu/core/context.h"

namespace parity::gpu {

/// Mathematics: cpu::sample_equirectangular, one value a direction. Float: places are off by 2^-21
/// of the width.
///
/// @throws std::invalid_argument  the picture is empty.
std::vector<vec4> sample_equirectangular(Context& context, const Grid<vec4>& picture,
                                         std::span<const vec3> directions);

/// Mathematics: cpu::sample_cube_map.
///
/// @throws std::invalid_argument  the height is not 6 times the width, or that is 0.
std::vector<vec4> sample_cube_map(Context& context, const Grid<vec4>& faces,
                                  std::span<const vec3> directions);

}  // namespace parity::gpu
