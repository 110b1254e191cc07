// The metallic-roughness BRDF and its answer to a uniform environment. Source: notes 6.2; glTF 2.0,
// appendix B; Heitz 2014 (height-correlated Smith); Karis 2014, "Physically based shading on mobile".
#ifndef PARITY_SHADING_METALLIC_ROUGHNESS_GLSL
#define PARITY_SHADING_METALLIC_ROUGHNESS_GLSL

const float pi = 3.14159265358979;

struct Microsurface {
  vec3 diffuse;     // albedo of the diffuse part, c_diff
  vec3 reflectance; // at normal incidence, F0
  float roughness;  // perceptual, at least 0.045
};

Microsurface microsurface(vec3 base, float metallic, float roughness) {
  return Microsurface(base * (1.0 - metallic), mix(vec3(0.04), base, metallic),
                      clamp(roughness, 0.045, 1.0));
}

// v / |v|; 0 stays 0.
vec3 unit_or_zero(vec3 v) {
  const float squared = dot(v, v);
  return squared > 0.0 ? v * (1.0 / sqrt(squared)) : vec3(0.0);
}

// The clamped cosine between the normal and the view.
float view_cosine(vec3 n, vec3 v) { return max(abs(dot(n, v)), 1e-4); }

// GGX. 1 - (n.h)^2 is taken from the cross product: the difference would lose all digits at small
// roughness.
float ggx_distribution(vec3 n, vec3 h, float alpha) {
  const vec3 sine = cross(n, h);
  const float cosine = clamp(dot(n, h), 0.0, 1.0);
  const float t = dot(sine, sine) + (cosine * alpha) * (cosine * alpha);
  return cosine > 0.0 ? alpha * alpha / (pi * t * t) : alpha * alpha / pi;
}

// G / (4 n.l n.v)
float smith_visibility(float n_l, float n_v, float alpha) {
  const float a2 = alpha * alpha;
  return 0.5 / (n_l * sqrt(n_v * n_v * (1.0 - a2) + a2) + n_v * sqrt(n_l * n_l * (1.0 - a2) + a2));
}

// BRDF times the cosine of the light, 1/sr. All directions point away from the surface.
vec3 reflect_light(Microsurface m, vec3 n, vec3 v, vec3 l) {
  const float n_l = clamp(dot(n, l), 0.0, 1.0);
  if (!(n_l > 0.0)) return vec3(0.0);
  const vec3 h = unit_or_zero(l + v);
  const float alpha = m.roughness * m.roughness;
  const float grazing = 1.0 - clamp(dot(v, h), 0.0, 1.0);
  const float grazing2 = grazing * grazing;
  const vec3 f = m.reflectance + (1.0 - m.reflectance) * (grazing2 * grazing2 * grazing);
  const float d_v = ggx_distribution(n, h, alpha) * smith_visibility(n_l, view_cosine(n, v), alpha);
  return ((1.0 - f) * m.diffuse * (1.0 / pi) + f * d_v) * n_l;
}

// Share of a uniform environment's radiance that comes back, without occlusion.
vec3 reflect_environment(Microsurface m, float n_v) {
  const vec4 r = m.roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
  const float a004 = min(r.x * r.x, exp2(-9.28 * n_v)) * r.x + r.y;
  const vec3 s = m.reflectance * (-1.04 * a004 + r.z) + (1.04 * a004 + r.w);
  return m.diffuse * (1.0 - s) + s;
}
#endif
