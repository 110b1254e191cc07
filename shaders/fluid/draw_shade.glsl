// What is seen along a ray. Source: notes 6.1 (Lambert, Blinn-Phong); Max 1995 (single scattering).
#ifndef PARITY_FLUID_DRAW_SHADE_GLSL
#define PARITY_FLUID_DRAW_SHADE_GLSL

#include "fluid/draw_volume.glsl"

struct DrawHit {
  float t;
  vec3 normal;
  vec3 color;
  float shine;
};

/// What lies behind everything.
vec3 draw_background(REF(DrawScene) s, vec3 direction) {
  if (s.at[0].has_floor == 0u) return s.at[0].horizon;
  return mix(s.at[0].horizon, s.at[0].zenith, smoothstep(0.0, 0.6, direction.y));
}

/// The nearest of the solids and the floor; t is draw_far if there is none.
DrawHit draw_hit_surroundings(REF(DrawScene) s, DrawRay ray) {
  DrawHit hit = DrawHit(draw_far, vec3(0.0, 1.0, 0.0), s.at[0].floor_color, 0.0);
  if (s.at[0].has_floor != 0u && ray.direction.y < 0.0 && ray.origin.y > s.at[0].floor_y)
    hit.t = (s.at[0].floor_y - ray.origin.y) / ray.direction.y;
  for (uint i = 0u; i < s.at[0].solid_count; ++i) {
    const DrawSolid solid = s.at[0].solids.at[i];
    const float t = draw_hit_solid(ray, solid);
    if (t < hit.t)
      hit = DrawHit(t, draw_solid_normal(solid, ray.origin + t * ray.direction), solid.color, 0.04);
  }
  return hit;
}

/// Light that a surface sends back along a ray.
vec3 draw_surface(REF(DrawScene) s, DrawRay ray, DrawHit hit) {
  const vec3 point = ray.origin + hit.t * ray.direction;
  const float lift = 1.5 * s.at[0].cell;
  const vec2 light = draw_light_at(s, point + lift * hit.normal);
  float sun = max(dot(hit.normal, s.at[0].sun), 0.0);
  if (sun > 0.0) sun *= light.x * draw_solids_sun(s, point + 1e-3 * lift * hit.normal);
  const vec3 around = mix(s.at[0].ground_color, s.at[0].sky_color, 0.5 + 0.5 * hit.normal.y);
  const vec3 halfway = normalize(s.at[0].sun - ray.direction);
  const float shine = hit.shine * pow(max(dot(hit.normal, halfway), 0.0), 40.0);
  const vec3 color = hit.color * (sun * s.at[0].sun_color + light.y * around) +
                     shine * step(1e-6, sun) * light.x * s.at[0].sun_color;
  const float far = 1.0 - exp(-pow(hit.t / s.at[0].fade, 2.0));
  return s.at[0].has_floor != 0u ? mix(color, s.at[0].horizon, far) : color;
}

/// (light, part that passes) of the smoke along a ray up to `end`.
vec4 draw_smoke(REF(DrawScene) s, DrawRay ray, float end) {
  const vec2 range = draw_hit_box(ray, s.at[0].volume_origin, draw_volume_high(s));
  const float begin = max(range.x, 0.0), stop = min(range.y, end), stride = 0.6 * s.at[0].cell;
  const float g = s.at[0].forward_scatter, angle = dot(ray.direction, s.at[0].sun);
  const float phase = (1.0 - g * g) / pow(1.0 + g * g - 2.0 * g * angle, 1.5);
  vec3 light = vec3(0.0);
  float passes = 1.0;
  for (uint k = 0u; k < 16384u && passes > 0.002; ++k) {
    const float t = begin + float(k) * stride;
    if (t >= stop) break;
    const vec4 cell = draw_cell(s, ray.origin + (t + 0.5 * stride) * ray.direction);
    if (cell.x <= 0.0) continue;
    const float left = exp(-cell.x * min(stride, stop - t));
    const vec3 comes = phase * cell.y * cell.w * s.at[0].sun_color +
                       cell.z * 0.5 * (s.at[0].sky_color + s.at[0].ground_color);
    light += passes * (1.0 - left) * s.at[0].medium * comes;
    passes *= left;
  }
  return vec4(light, passes);
}

vec3 draw_seen(REF(DrawScene) s, DrawRay ray, DrawHit particle) {
  DrawHit hit = draw_hit_surroundings(s, ray);
  if (particle.t < hit.t) hit = particle;
  const vec3 behind =
      hit.t < draw_far ? draw_surface(s, ray, hit) : draw_background(s, ray.direction);
  if (s.at[0].mode != volume_smoke) return behind;
  const vec4 smoke = draw_smoke(s, ray, hit.t);
  return smoke.rgb + smoke.a * behind;
}

#endif
