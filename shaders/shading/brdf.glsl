// A BRDF by its number. Source: notes 6.1, 6.2.
#ifndef PARITY_SHADING_BRDF_GLSL
#define PARITY_SHADING_BRDF_GLSL
#include "shading/fresnel.glsl"
#include "shading/layout.h"
#include "shading/microfacet.glsl"
#include "shading/multi_scatter.glsl"
#include "shading/phong.glsl"

vec3 fresnel_of(BrdfQuery q, float cosine) {
  if (q.fresnel == fresnel_schlick) return fresnel_of_schlick(q.color, cosine);
  if (q.fresnel == fresnel_dielectric) return vec3(fresnel_of_dielectric(q.color.x, cosine));
  return vec3(fresnel_of_conductor(q.color.x, q.absorption.x, cosine),
              fresnel_of_conductor(q.color.y, q.absorption.y, cosine),
              fresnel_of_conductor(q.color.z, q.absorption.z, cosine));
}

vec3 cook_torrance(BrdfQuery q) {
  const vec3 l = q.to_light;
  const vec3 v = q.to_eye;
  const vec3 h = normalize(l + v);
  const vec2 slope = h.xy / q.alpha;
  const float slope2 = dot(slope, slope);
  const float product = q.alpha.x * q.alpha.y;
  float d_v;
  if (q.model == brdf_beckmann)
    d_v = beckmann_distribution(slope2, h.z, product) * beckmann_visibility(l, v, q.alpha);
  else
    d_v = ggx_distribution(slope2, h.z, product) *
          ggx_visibility(l.z, v.z, length(vec3(q.alpha * l.xy, l.z)),
                         length(vec3(q.alpha * v.xy, v.z)));
  return fresnel_of(q, dot(v, h)) * d_v;
}

vec3 sheen(BrdfQuery q) {
  const vec3 h = normalize(q.to_light + q.to_eye);
  return q.color * charlie_distribution(dot(h.xy, h.xy), q.alpha.x) *
         cloth_visibility(q.to_light.z, q.to_eye.z);
}

// 1/sr; 0 below the horizon on either side.
vec3 brdf(BrdfQuery q, ref_vec4 albedo_table) {
  const vec3 l = q.to_light;
  const vec3 v = q.to_eye;
  if (!(l.z > 0.0) || !(v.z > 0.0)) return vec3(0.0);
  if (q.model == brdf_lambert) return q.color * (1.0 / pi);
  if (q.model == brdf_phong) return q.color * phong_lobe(l, v, q.exponent);
  if (q.model == brdf_phong_normalized)
    return q.color * (phong_factor(q.exponent) * phong_lobe(l, v, q.exponent));
  if (q.model == brdf_blinn_phong) return q.color * blinn_phong_lobe(l, v, q.exponent);
  if (q.model == brdf_blinn_phong_normalized)
    return q.color * (blinn_phong_factor(q.exponent) * blinn_phong_lobe(l, v, q.exponent));
  if (q.model == brdf_sheen) return sheen(q);
  vec3 result = cook_torrance(q);
  if (q.model == brdf_ggx_multi_scatter) {
    const float roughness = sqrt(q.alpha.x);
    result += multi_scatter(albedo_at(albedo_table, l.z, roughness),
                            albedo_at(albedo_table, v.z, roughness), q.color, 1.0);
  }
  return result;
}
#endif
