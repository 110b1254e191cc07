#pragma once

#include <span>
#include <vector>

#include "geometry/frame.h"
#include "gpu/core/context.h"
#include "shaders/raster/scene_layout.h"

namespace parity::gpu {

/// A light as the shaders read it, relative to an origin.
SceneLight scene_light(const PlacedLight& light, const dvec3& origin);

/// What each light sends to its point: the unit way to the light, and the irradiance of red on a
/// surface that faces it.
///
/// @throws std::invalid_argument  not one point a light.
///
/// Mathematics: cpu::incoming.
std::vector<vec4> punctual_light(Context& context, std::span<const PlacedLight> lights,
                                 std::span<const vec3> points);

}  // namespace parity::gpu
