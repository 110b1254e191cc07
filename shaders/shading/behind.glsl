// What is opaque, seen through what transmits light: a picture of it with coarser levels.
// Source: KHR_materials_transmission and _volume, implementation notes (rough glass reads a coarser
// level at the place where the refracted ray leaves).
#ifndef PARITY_SHADING_BEHIND_GLSL
#define PARITY_SHADING_BEHIND_GLSL
#include "raster/scene_layout.h"

// Of the frame: there is such a picture.
layout(constant_id = 27) const bool has_behind = true;

// Bilinear between the middles of texels; what is beyond the sides is what is at them.
vec4 behind_texel(ref_SceneScreen s, uint level, vec2 place) {
  const uvec2 size = max(s.at[0].behind_size >> level, uvec2(1u));
  const vec2 last = vec2(size - 1u);
  const vec2 at = clamp(place * vec2(size) - 0.5, vec2(0.0), last);
  const vec2 low = min(floor(at), max(last - 1.0, vec2(0.0)));
  const vec2 part = at - low;
  const uvec2 a = uvec2(low), b = min(a + 1u, size - 1u);
  const uint begin = s.at[0].behind_begins[level];
  const vec4 top = mix(s.at[0].behind.at[begin + a.y * size.x + a.x],
                       s.at[0].behind.at[begin + a.y * size.x + b.x], part.x);
  const vec4 bottom = mix(s.at[0].behind.at[begin + b.y * size.x + a.x],
                          s.at[0].behind.at[begin + b.y * size.x + b.x], part.x);
  return mix(top, bottom, part.y);
}

// The premultiplied colour where a position is seen; roughness 0.045 reads the finest level, 1 the
// coarsest. A position beside or behind the eye shows the middle.
vec4 picture_behind(ref_SceneScreen s, vec3 p, float roughness) {
  const mat4 m = s.at[0].clip_from_position;
  const vec4 clip = ((m[0] * p.x + m[1] * p.y) + m[2] * p.z) + m[3];
  vec2 place = vec2(0.5);
  if (clip.w > 0.0) place = clip.xy / clip.w * 0.5 + 0.5;
  const uint last = s.at[0].behind_levels - 1u;
  const float level = clamp((roughness - 0.045) / 0.955, 0.0, 1.0) * float(last);
  const uint i = min(uint(level), last);
  return mix(behind_texel(s, i, place), behind_texel(s, min(i + 1u, last), place), level - float(i));
}
#endif
