#pragma once

#include <span>
#include <vector>

#include "geometry/camera.h"
#include "geometry/transform.h"

namespace parity::cpu {

/// Clip from view for Vulkan: x right, y DOWN, the frustum's depth 0 (near) to 1 (far); 1 to 0 with
/// reverse-Z. Logarithmic depth is written by the fragment and clips like standard. `far` may be
/// infinite. One matrix a volume.
///
/// @throws std::invalid_argument  an empty side, near <= 0, far <= near, or a NaN.
///
/// Source: notes 2.6; Vulkan 1.3, "Coordinate Transformations". Depth differs from the notes, which
/// map it to [-1, 1] with y up.
std::vector<dmat4> perspective(std::span<const ViewVolume> volumes, DepthMode depth);

/// The notes' matrix for OpenGL: y up, depth -1 (near) to 1 (far).
///
/// Source: notes 2.6.
dmat4 perspective_gl(const ViewVolume& volume);

/// Squeezes the frustum into a box: x' = n x / (-z), y' = n y / (-z), and z = -n and z = -f stay
/// where they are.
///
/// @param near, far  m, 0 < near < far < infinity.
///
/// Source: notes 2.6.
/// Erratum: the last rows in the notes are (0, 0, n + f, -f n), (0, 0, 1, 0), which gives w' = z
/// where the text says -z; right for positive n and f are (0, 0, n + f, f n), (0, 0, -1, 0).
dmat4 squeeze(double near, double far);

/// Distance of an image of this height at which it fills the vertical field of view (rad).
///
/// Source: notes 2.6.
double focal_length(double height, double vertical_fov);

}  // namespace parity::cpu
