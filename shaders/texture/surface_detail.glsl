// Normals of bumped and normal-mapped surfaces. Source: notes 6.3; Blinn 1978; glTF 2.0, 3.9.3.
#ifndef PARITY_TEXTURE_SURFACE_DETAIL_GLSL
#define PARITY_TEXTURE_SURFACE_DETAIL_GLSL
#include "texture/layout.h"

// The cross product of the raised surface's derivatives P_u + h_u n and P_v + h_v n, unit.
vec3 bump(vec3 p_u, vec3 p_v, vec2 slope) {
  const vec3 along = cross(p_u, p_v);
  const vec3 n = along / sqrt(dot(along, along));
  const vec3 bent = along + slope.x * cross(n, p_v) + slope.y * cross(p_u, n);
  return bent / sqrt(dot(bent, bent));
}

// n and t of unit length, handedness +-1, texel 0 to 1. Not normalised.
vec3 bent_normal(vec3 n, vec3 t, float handedness, vec3 texel, float scale) {
  const vec2 xy = (2.0 * texel.xy - 1.0) * scale;
  return xy.x * t + xy.y * handedness * cross(n, t) + (2.0 * texel.z - 1.0) * n;
}
#endif
