#pragma once

#include <limits>
#include <string>

#include "geometry/math.h"

namespace parity {

enum class LightKind { directional, point, spot };

/// KHR_lights_punctual. Shines along -z of its node.
struct Light {
  std::string name;
  LightKind kind = LightKind::point;
  vec3 color{1.0f};                                      ///< linear RGB
  float intensity = 1.0f;                                ///< directional: lx; point and spot: cd
  float range = std::numeric_limits<float>::infinity();  ///< m
  float inner_cone_angle = 0.0f;                         ///< rad, spot
  float outer_cone_angle = 0.785398163f;                 ///< rad, spot
};

}  // namespace parity
