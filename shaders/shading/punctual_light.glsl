// What a punctual light sends to a point. Source: notes 6.1; glTF 2.0, KHR_lights_punctual.
#ifndef PARITY_SHADING_PUNCTUAL_LIGHT_GLSL
#define PARITY_SHADING_PUNCTUAL_LIGHT_GLSL
#include "raster/scene_layout.h"

// Of the frame: kinds that are not there are left out.
layout(constant_id = 15) const bool has_placed_lights = true;  // points and spots

// Irradiance on a surface that faces the light, and the way to it.
struct IncidentLight {
  vec3 irradiance;
  vec3 to_light;  // unit; 0 at the light itself
};

IncidentLight incident_light(SceneLight light, vec3 p) {
  if (!has_placed_lights || light.kind == light_directional) return IncidentLight(light.intensity, -light.direction);
  const vec3 d = light.position - p;
  const float squared = dot(d, d);
  if (!(squared > 0.0)) return IncidentLight(vec3(0.0), vec3(0.0));
  const vec3 l = d / sqrt(squared);
  const float q = squared * light.inverse_range * light.inverse_range;
  float share = clamp(1.0 - q * q, 0.0, 1.0) / squared;
  if (light.kind == light_spot) {
    const float cone = clamp(dot(light.direction, -l) * light.angle_scale + light.angle_offset, 0.0, 1.0);
    share *= cone * cone;
  }
  return IncidentLight(light.intensity * share, l);
}
#endif
