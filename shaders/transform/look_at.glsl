// View matrix. Source: notes 2.5.
#ifndef PARITY_TRANSFORM_LOOK_AT_GLSL
#define PARITY_TRANSFORM_LOOK_AT_GLSL

#include "transform/layout.h"

/// v scaled to length 1; scaled by its greatest component first, so that squares stay in range.
vec3 unit(vec3 v) {
  const float greatest = max(max(abs(v.x), abs(v.y)), abs(v.z));
  precise vec3 scaled = v / greatest;
  precise vec3 result = scaled / sqrt(dot(scaled, scaled));
  return result;
}

/// View from world: right, up and backward as rows, the eye at the origin.
mat4 look_at(LookAtRecord camera) {
  precise vec3 along = camera.center - camera.eye;
  const vec3 forward = unit(along);
  precise vec3 aside = cross(forward, unit(camera.up));
  const vec3 right = unit(aside);
  precise vec3 up = cross(right, forward);
  precise vec3 shift = vec3(-dot(right, camera.eye), -dot(up, camera.eye), dot(forward, camera.eye));
  return transpose(mat4(vec4(right, shift.x), vec4(up, shift.y), vec4(-forward, shift.z),
                        vec4(0.0, 0.0, 0.0, 1.0)));
}

#endif
