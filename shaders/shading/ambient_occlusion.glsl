// How much of the sky over a surface is free, from distances along the view: the horizon on both
// sides of some slices through the view. Source: notes 6.2; Jimenez, Wu, Pesce & Jarabo 2016
// ("Practical Realtime Strategies for Accurate Indirect Occlusion").
#ifndef PARITY_SHADING_AMBIENT_OCCLUSION_GLSL
#define PARITY_SHADING_AMBIENT_OCCLUSION_GLSL
#include "shading/layout.h"

const float occlusion_fade = 0.7;  // of the radius: from there what hides the sky counts less

// Of a cosine that may be rounded beyond its ends. Source: Abramowitz & Stegun 4.4.46.
float angle_of(float cosine) {
  const float x = min(abs(cosine), 1.0);
  float sum = -0.0012624911;
  sum = sum * x + 0.0066700901;
  sum = sum * x - 0.0170881256;
  sum = sum * x + 0.0308918810;
  sum = sum * x - 0.0501743046;
  sum = sum * x + 0.0889789874;
  sum = sum * x - 0.2145988016;
  sum = sum * x + 1.5707963050;
  const float angle = sqrt(1.0 - x) * sum;
  return cosine < 0.0 ? 3.14159265 - angle : angle;
}

float sine_of(float cosine) { return sqrt(max(1.0 - cosine * cosine, 0.0)); }

// Integral of cos(t - g) sin t from 0 to the horizon, where g is the angle of the normal.
float arc_to(float horizon_cosine, float normal_cosine, float normal_sine) {
  const float sine = sine_of(horizon_cosine);
  return 0.5 * (sine * sine * normal_cosine +
                (angle_of(horizon_cosine) - sine * horizon_cosine) * normal_sine);
}

struct OcclusionView {
  vec2 slope;
  vec2 size;
  bool orthographic;
};

vec3 position_at(OcclusionView view, ivec2 pixel, float distance) {
  const vec2 part = (2.0 * vec2(pixel) + 1.0) / view.size - 1.0;
  const float w = view.orthographic ? 1.0 : distance;
  return vec3(part.x * view.slope.x * w, -part.y * view.slope.y * w, -distance);
}

vec3 eye_from(OcclusionView view, vec3 p) {
  return view.orthographic ? vec3(0.0, 0.0, 1.0) : -p * inversesqrt(dot(p, p));
}
#endif
