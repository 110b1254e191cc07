#pragma once

#include "geometry/grid.h"
#include "geometry/math.h"

namespace parity::cpu {

/// Light from a direction, of an equirectangular picture (Projection::spherical), bilinearly: the
/// last column meets the first, and over a pole the rows go on half a turn further. No seams.
///
/// @param picture    at least 1x1; an even width, or the poles are off by half a texel.
/// @param direction  any length but 0.
///
/// Source: notes 6.3.
dvec4 sample_equirectangular(const Grid<vec4>& picture, dvec3 direction);

/// The same of a cube map (Projection::cubic): across an edge the texels of the other face are
/// taken, at a corner the mean of the three that meet.
///
/// @param faces  +x -x +y -y +z -z, one below the other: side x 6 side.
///
/// Source: Vulkan 1.3, "Cube Map Edge Handling".
dvec4 sample_cube_map(const Grid<vec4>& faces, dvec3 direction);

}  // namespace parity::cpu
