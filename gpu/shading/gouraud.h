#pragma once

#include <span>
#include <vector>

#include "geometry/math.h"
#include "gpu/core/context.h"
#include "shaders/shading/layout.h"

namespace parity::gpu {

/// Gouraud's and Phong's shading of points of triangles. Mathematics: cpu::gouraud.
std::vector<vec2> gouraud(Context& context, std::span<const GouraudQuery> queries);

}  // namespace parity::gpu
