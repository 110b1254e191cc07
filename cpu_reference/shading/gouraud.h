#pragma once

#include <span>
#include <vector>

#include "geometry/math.h"
#include "shaders/shading/layout.h"

namespace parity::cpu {

/// Radiance at points of triangles under a point light of 1 W/sr, of a surface with diffuse albedo
/// 1 - specular and a normalised Blinn-Phong highlight of strength `specular`: x interpolated from
/// the corners (Gouraud), y shaded with the interpolated position and normal (Phong).
///
/// Source: notes 6.1; Gouraud 1971; Phong 1975.
std::vector<dvec2> gouraud(std::span<const GouraudQuery> queries);

}  // namespace parity::cpu
