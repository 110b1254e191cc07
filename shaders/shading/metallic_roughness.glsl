// The metallic-roughness BRDF. Source: notes 6.2; glTF 2.0, appendix B; Heitz 2014 (height-correlated
// Smith); Kulla & Conty 2017 (several bounces).
#ifndef PARITY_SHADING_METALLIC_ROUGHNESS_GLSL
#define PARITY_SHADING_METALLIC_ROUGHNESS_GLSL
#include "shading/fresnel.glsl"
#include "shading/microfacet.glsl"
#include "shading/multi_scatter.glsl"

layout(constant_id = 25) const bool has_metal = true;  // of any material

struct Microsurface {
  vec3 diffuse;      // albedo of the diffuse part, c_diff
  vec3 reflectance;  // at normal incidence, F0: of dielectric and metal, mixed
  float grazing;     // at grazing angles, F90
  vec2 border;       // F0 and F90 over the diffuse part: of a dielectric, its largest channel
  float roughness;   // perceptual, at least 0.045
  vec3 dielectric;   // F0 of either
  vec3 metal;
  float metallic;
  vec3 albedo;       // of the table, toward the eye
};

// v / |v|; 0 stays 0.
vec3 unit_or_zero(vec3 v) {
  const float squared = dot(v, v);
  return squared > 0.0 ? v * (1.0 / sqrt(squared)) : vec3(0.0);
}

// The clamped cosine between the normal and the view.
float view_cosine(vec3 n, vec3 v) { return max(abs(dot(n, v)), 1e-4); }

// D V of an isotropic surface.
float microfacet_lobe(vec3 n, vec3 h, float n_l, float n_v, float roughness) {
  const float alpha = roughness * roughness;
  return ggx_distribution(n, h, alpha) * smith_visibility(n_l, n_v, alpha);
}

// BRDF of the base, 1/sr, from D V and the cosine between the eye and the half vector.
vec3 base_reflection(Microsurface m, float lobe, float v_h, float n_l, ref_vec4 albedo_table) {
  const float weight = schlick_weight(v_h);
  const vec3 f = m.reflectance + (m.grazing - m.reflectance) * weight;
  const float passed = 1.0 - (m.border.x + (m.border.y - m.border.x) * weight);
  vec3 sum = m.diffuse * (passed * (1.0 / pi)) + f * lobe;
  if (has_metal && m.metallic > 0.0)
    sum += m.metallic * multi_scatter(albedo_at(albedo_table, n_l, m.roughness), m.albedo, m.metal, 1.0);
  return sum;
}

// BRDF times the cosine of the light, 1/sr. All directions point away from the surface.
vec3 reflect_light(Microsurface m, vec3 n, vec3 v, vec3 l, ref_vec4 albedo_table) {
  const float n_l = clamp(dot(n, l), 0.0, 1.0);
  if (!(n_l > 0.0)) return vec3(0.0);
  const vec3 h = unit_or_zero(l + v);
  const float lobe = microfacet_lobe(n, h, n_l, view_cosine(n, v), m.roughness);
  return base_reflection(m, lobe, dot(v, h), n_l, albedo_table) * n_l;
}

// Shares of the light from all around: of what the mirror shows, of the mean radiance over the
// hemisphere after several bounces, and what enters the body. Source: Fdez-Aguera 2019.
struct EnvironmentShares {
  vec3 mirror;
  vec3 bounced;
  float entering;
};

// What several bounces add to a single one, for the light from all around.
vec3 several(Microsurface m, vec3 f0, float f90) {
  const float lost = 1.0 - (m.albedo.x + m.albedo.y);
  const vec3 mean = mean_schlick(f0, f90);
  return (f0 * m.albedo.x + f90 * m.albedo.y) * mean / (1.0 - lost * mean) * lost;
}

EnvironmentShares environment_shares(Microsurface m) {
  EnvironmentShares s;
  s.mirror = m.reflectance * m.albedo.x + m.grazing * m.albedo.y;
  s.bounced = several(m, m.dielectric, m.border.y) * (1.0 - m.metallic);
  if (has_metal) s.bounced += several(m, m.metal, 1.0) * m.metallic;
  s.entering = 1.0 - (m.border.x * m.albedo.x + m.border.y * m.albedo.y) -
               several(m, m.border.xxx, m.border.y).x;
  return s;
}
#endif
