// The vertex stage of the scene: what is decided here (clip positions) and what is interpolated.
#ifndef PARITY_RASTER_SCENE_VERTEX_GLSL
#define PARITY_RASTER_SCENE_VERTEX_GLSL
#include "raster/scene_layout.h"

// Both sides round alike, so that coverage can be compared bit by bit.
vec4 clip_position(mat4 clip_from_object, vec3 p) {
  precise const vec4 clip =
      ((clip_from_object[0] * p.x + clip_from_object[1] * p.y) + clip_from_object[2] * p.z) +
      clip_from_object[3];
  return clip;
}

// What is interpolated of vertex `v` of a draw.
vec2 vertex_uv(SceneDraw draw, uint slot, uint v) {
  if ((draw.flags & (draw_flag_uvs << slot)) == 0u) return vec2(0.0);
  return draw.uvs[slot].at[v];
}

// Those of slots 2 pair and 2 pair + 1; `pair` is a constant wherever this is called.
vec4 vertex_uv_pair(SceneDraw draw, uint pair, uint v) {
  return vec4(vertex_uv(draw, 2u * pair, v), vertex_uv(draw, 2u * pair + 1u, v));
}

vec3 vertex_position(SceneDraw draw, vec3 p) { return draw.world_from_object * p + draw.world_origin; }

vec3 vertex_normal(SceneDraw draw, uint v) {
  if ((draw.flags & draw_flag_normals) == 0u) return vec3(0.0);
  return draw.world_from_object_normal * draw.normals.at[v];
}

vec4 vertex_tangent(SceneDraw draw, uint v) {
  if ((draw.flags & draw_flag_tangents) == 0u) return vec4(0.0, 0.0, 0.0, 1.0);
  const vec4 t = draw.tangents.at[v];
  const float handedness = (draw.flags & draw_flag_mirrored) != 0u ? -t.w : t.w;
  return vec4(draw.world_from_object * t.xyz, handedness);
}

vec4 vertex_color(SceneDraw draw, uint v) {
  if ((draw.flags & draw_flag_colors) == 0u) return vec4(1.0);
  return draw.colors.at[v];
}
#endif
