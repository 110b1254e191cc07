#pragma once

#include <span>
#include <vector>

#include "geometry/camera.h"
#include "geometry/transform.h"

namespace parity::cpu {

/// Clip from view of a box for Vulkan: x right, y DOWN, depth 0 (near) to 1 (far); 1 to 0 with
/// reverse-Z. The centre moves to the origin, then the box is scaled. One matrix a volume.
///
/// @throws std::invalid_argument  an empty or infinite side, or near == far. near may be <= 0.
///
/// Source: notes 2.6, which give no formula.
std::vector<dmat4> orthographic(std::span<const ViewVolume> volumes, DepthMode depth);

}  // namespace parity::cpu
