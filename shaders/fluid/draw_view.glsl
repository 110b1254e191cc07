// Rays of a picture and what they meet: particles, solids, the floor.
#ifndef PARITY_FLUID_DRAW_VIEW_GLSL
#define PARITY_FLUID_DRAW_VIEW_GLSL

#include "fluid/draw_layout.h"

const float draw_far = 1e30;

struct DrawRay {
  vec3 origin;
  vec3 direction;
};

/// Through the middle of a sample.
DrawRay draw_ray(REF(DrawScene) s, uint x, uint y) {
  precise float u = 2.0 * (float(x) + 0.5) / float(s.at[0].width) - 1.0;
  precise float v = 1.0 - 2.0 * (float(y) + 0.5) / float(s.at[0].height);
  precise vec3 aside = u * s.at[0].right + v * s.at[0].up;
  if (s.at[0].is_orthographic != 0u) return DrawRay(s.at[0].eye + aside, s.at[0].forward);
  precise vec3 along = s.at[0].forward + aside;
  precise float size = sqrt(along.x * along.x + along.y * along.y + along.z * along.z);
  return DrawRay(s.at[0].eye, along / size);
}

/// Distance to a sphere from outside; draw_far if it is missed. The same bits in every kernel.
float draw_hit_sphere(DrawRay ray, vec3 center, float radius) {
  precise vec3 to = center - ray.origin;
  precise float along =
      to.x * ray.direction.x + to.y * ray.direction.y + to.z * ray.direction.z;
  precise vec3 aside = to - along * ray.direction;
  precise float rest =
      radius * radius - (aside.x * aside.x + aside.y * aside.y + aside.z * aside.z);
  if (!(rest >= 0.0)) return draw_far;
  precise float t = along - sqrt(rest);
  return t > 0.0 ? t : draw_far;
}

/// Where a ray is inside a box: x enters, y leaves; y < x: nowhere.
vec2 draw_hit_box(DrawRay ray, vec3 low, vec3 high) {
  const vec3 inverse = 1.0 / mix(ray.direction, vec3(1e-20), lessThan(abs(ray.direction), vec3(1e-20)));
  const vec3 a = (low - ray.origin) * inverse, b = (high - ray.origin) * inverse;
  const vec3 first = min(a, b), last = max(a, b);
  return vec2(max(max(first.x, first.y), first.z), min(min(last.x, last.y), last.z));
}

/// Distance to a solid from outside.
float draw_hit_solid(DrawRay ray, DrawSolid solid) {
  if (solid.is_box == 0u) return draw_hit_sphere(ray, solid.low, solid.high.x);
  const vec2 range = draw_hit_box(ray, solid.low, solid.high);
  return range.y >= range.x && range.x > 0.0 ? range.x : draw_far;
}

vec3 draw_solid_normal(DrawSolid solid, vec3 point) {
  if (solid.is_box == 0u) return normalize(point - solid.low);
  const vec3 to = (point - 0.5 * (solid.low + solid.high)) / (0.5 * (solid.high - solid.low));
  const vec3 size = abs(to);
  if (size.x >= size.y && size.x >= size.z) return vec3(sign(to.x), 0.0, 0.0);
  return size.y >= size.z ? vec3(0.0, sign(to.y), 0.0) : vec3(0.0, 0.0, sign(to.z));
}

/// 0 where a solid stands before the sun, else 1.
float draw_solids_sun(REF(DrawScene) s, vec3 point) {
  const DrawRay ray = DrawRay(point, s.at[0].sun);
  for (uint i = 0u; i < s.at[0].solid_count; ++i) {
    const DrawSolid solid = s.at[0].solids.at[i];
    if (solid.casts_shadow != 0u && draw_hit_solid(ray, solid) < draw_far) return 0.0;
  }
  return 1.0;
}

#endif
