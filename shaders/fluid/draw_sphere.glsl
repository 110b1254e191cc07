// The samples that a particle may cover, and its distance there.
#ifndef PARITY_FLUID_DRAW_SPHERE_GLSL
#define PARITY_FLUID_DRAW_SPHERE_GLSL

#include "fluid/draw_view.glsl"

/// Tangents of the directions that touch a circle of radius r at (aside, ahead), ahead > r.
vec2 draw_tangents(float aside, float ahead, float r) {
  const float middle = atan(aside, ahead), half_angle = asin(r / length(vec2(aside, ahead)));
  return vec2(tan(middle - half_angle), tan(middle + half_angle));
}

/// First and last sample along x (xy) and y (zw); last < first: none.
ivec4 draw_sphere_bounds(REF(DrawScene) s, vec3 center) {
  const float r = s.at[0].radius;
  const float right = length(s.at[0].right), up = length(s.at[0].up);
  const vec3 to = center - s.at[0].eye;
  const float x = dot(to, s.at[0].right) / right, y = dot(to, s.at[0].up) / up;
  vec2 u = vec2(x - r, x + r), v = vec2(y - r, y + r);
  if (s.at[0].is_orthographic == 0u) {
    const float ahead = dot(to, s.at[0].forward);
    if (!(ahead > 1.01 * r)) return ivec4(0, -1, 0, -1);
    u = draw_tangents(x, ahead, r);
    v = draw_tangents(y, ahead, r);
  }
  const vec2 size = vec2(s.at[0].width, s.at[0].height);
  const vec2 columns = (u / right + 1.0) * 0.5 * size.x, rows = (1.0 - v.yx / up) * 0.5 * size.y;
  // A sample more on each side: rounding must not cut a sphere.
  const vec4 bounds = vec4(columns.x - 1.5, columns.y + 0.5, rows.x - 1.5, rows.y + 0.5);
  return ivec4(clamp(bounds, vec4(0.0, -1.0, 0.0, -1.0),
                     vec4(size.x, size.x - 1.0, size.y, size.y - 1.0)));
}

#endif
