// Values between the centres of cells, and how much light comes to a point.
#ifndef PARITY_FLUID_DRAW_VOLUME_GLSL
#define PARITY_FLUID_DRAW_VOLUME_GLSL

#include "fluid/draw_view.glsl"

const uint volume_none = 0u;
const uint volume_smoke = 2u;

vec3 draw_volume_high(REF(DrawScene) s) {
  return s.at[0].volume_origin + s.at[0].cell * vec3(s.at[0].volume_size);
}

/// The eight cells around a point and how far it is between them; beyond the centres of the
/// outermost cells values go on unchanged.
struct DrawCorners {
  uint first;
  uvec3 step;
  vec3 part;
};

DrawCorners draw_corners(REF(DrawScene) s, vec3 point) {
  const ivec3 n = s.at[0].volume_size;
  const vec3 at = clamp((point - s.at[0].volume_origin) / s.at[0].cell - 0.5, vec3(0.0), vec3(n - 1));
  const ivec3 low = max(min(ivec3(at), n - 2), ivec3(0));
  const uvec3 pitch = uvec3(1, n.x, n.x * n.y);
  const uvec3 first = uvec3(low) * pitch;
  return DrawCorners(first.x + first.y + first.z,
                     mix(uvec3(0), pitch, greaterThan(n, ivec3(1))), at - vec3(low));
}

/// (value, sun, sky, lit).
vec4 draw_cell(REF(DrawScene) s, vec3 point) {
  const DrawCorners c = draw_corners(s, point);
  vec4 rows[4];
  for (uint k = 0u; k < 4u; ++k) {
    const uint i = c.first + (k & 1u) * c.step.y + (k >> 1) * c.step.z;
    const DrawCell a = s.at[0].cells.at[i], b = s.at[0].cells.at[i + c.step.x];
    rows[k] = mix(vec4(a.value, a.sun, a.sky, a.lit), vec4(b.value, b.sun, b.sky, b.lit), c.part.x);
  }
  return mix(mix(rows[0], rows[1], c.part.y), mix(rows[2], rows[3], c.part.y), c.part.z);
}

/// (sun, sky): what part of each comes to a point, inside the volume or beside it.
vec2 draw_light_at(REF(DrawScene) s, vec3 point) {
  if (s.at[0].mode == volume_none) return vec2(1.0);
  const vec3 low = s.at[0].volume_origin, high = draw_volume_high(s);
  const vec3 nearest = clamp(point, low, high);
  const float away = length(point - nearest);
  const float reach = 0.25 * (high.y - low.y);
  vec4 cell = draw_cell(s, nearest);
  const float sky = mix(cell.z, 1.0, min(away / reach, 1.0));
  if (away == 0.0) return vec2(cell.y, sky);
  const DrawRay ray = DrawRay(point, s.at[0].sun);
  const vec2 range = draw_hit_box(ray, low, high);
  if (range.y <= max(range.x, 0.0)) return vec2(1.0, sky);
  cell = draw_cell(s, point + max(range.x, 0.0) * ray.direction);
  return vec2(cell.y, sky);
}

#endif
