#pragma once

#include <span>
#include <vector>

#include "geometry/grid.h"
#include "geometry/math.h"
#include "gpu/core/context.h"
#include "shaders/texture/layout.h"

namespace parity::gpu {

/// Mathematics: cpu::bump.
std::vector<vec3> bump(Context& context, std::span<const SurfaceDetail> details);

/// Mathematics: cpu::normal_map.
std::vector<vec3> normal_map(Context& context, std::span<const SurfaceDetail> details);

/// u, v and depth where rays meet a height field. Mathematics: cpu::parallax.
///
/// @throws std::invalid_argument  no texels, or layers not in 1..1024.
std::vector<vec3> parallax(Context& context, const Grid<u8vec4>& heights,
                           std::span<const ParallaxRay> rays, float scale, int layers);

}  // namespace parity::gpu
