#pragma once

#include <span>
#include <vector>

#include "geometry/math.h"
#include "gpu/core/context.h"

namespace parity::gpu {

/// Window x, y in pixels (y down, the centre of pixel 0 at 0.5), depth, and 1/w of clip positions
/// with w > 0.
///
/// @throws std::invalid_argument  width or height is not 1 to 16384.
///
/// Mathematics: notes 1.2; Vulkan 1.3, "Controlling the Viewport". x and y are rounded as
/// Snapping::mesa says: fma(x (1/w), W/2, W/2).
std::vector<vec4> to_window(Context& context, std::span<const vec4> clip_positions, int width,
                            int height);

}  // namespace parity::gpu
