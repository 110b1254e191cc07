// How much of a light of a scene reaches a point. Source: notes 6.1; Holbert 2011 ("Saying Goodbye to
// Shadow Acne": receivers are moved along their normals).
#ifndef PARITY_SHADING_LIGHT_SHADOW_GLSL
#define PARITY_SHADING_LIGHT_SHADOW_GLSL
#include "raster/scene_layout.h"
#include "shading/shadow_map.glsl"

// Of the frame: some light may be hidden.
layout(constant_id = 24) const bool has_shadows = true;

const uint no_map = 6u;

// Which map of a cube shows what lies that way: along the largest component, of equal ones the first.
uint cube_face(vec3 way) {
  const vec3 a = abs(way);
  const uint axis = a.x >= max(a.y, a.z) ? 0u : (a.y >= a.z ? 1u : 2u);
  return 2u * axis + (way[axis] < 0.0 ? 1u : 0u);
}

uint shadow_map_of(SceneShadow s, vec3 p) {
  if (s.is_cube != 0u) return cube_face(p - s.center);
  const uint k = shadow_cascade(s.ends, dot(s.forward, p) + s.offset);
  return k == 4u ? no_map : k;
}

float light_reaches(SceneArgs args, uint number, vec3 p, vec3 n) {
  if (!has_shadows || number == 0u) return 1.0;
  SceneShadow s = args.shadows.at[number - 1u];
  const uint k = shadow_map_of(s, p);
  if (k == no_map) return 1.0;
  const mat4 m = s.shadow_from_position[k];
  const float w = dot(vec3(m[0].w, m[1].w, m[2].w), p) + m[3].w;
  const vec3 lifted = p + n * (s.lifts[k] * w);
  const vec4 place = ((m[0] * lifted.x + m[1] * lifted.y) + m[2] * lifted.z) + m[3];
  if (!(place.w > 0.0)) return 1.0;
  const float depth = min(place.z / place.w - s.bias, 1.0);
  return shadow_filter(s.depths, k * s.side * s.side, int(s.side), place.xy / place.w, depth,
                       int(s.radius));
}
#endif
