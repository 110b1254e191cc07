#version 460
#include "shading/fresnel.glsl"
#include "shading/layout.h"
#include "shading/microfacet.glsl"
#include "shading/multi_scatter.glsl"
#include "transform/trigonometry.glsl"

// Part of white light from everywhere that a rough surface sends to the eye: what enters the split
// sum and the multiple-scattering term. One thread an entry. Normals are drawn from those that the
// eye sees, so that an integrand within 0..1 is left; the sheen is summed over the hemisphere.
// Source: Karis 2013; Heitz 2018 ("Sampling the GGX distribution of visible normals"); Kulla & Conty
// 2017. Differs from Heitz: midpoints of a grid, not random numbers.
layout(local_size_x = 32) in;
layout(scalar, push_constant) uniform Push { AlbedoTableArgs args; };

// Direction of a cosine in the x-z plane.
vec3 toward(float cosine) { return vec3(sqrt(max(1.0 - cosine * cosine, 0.0)), 0.0, cosine); }

vec3 visible_normal(vec3 v, float alpha, vec2 u) {
  const vec3 stretched = normalize(vec3(alpha * v.x, 0.0, v.z));
  const vec3 along = vec3(-stretched.z, 0.0, stretched.x);  // across is the y axis
  const vec2 disk = sqrt(u.x) * sin_cos(2.0 * pi * u.y).yx;
  const float y = mix(sqrt(max(1.0 - disk.x * disk.x, 0.0)), disk.y, 0.5 + 0.5 * stretched.z);
  const float up = sqrt(max(1.0 - disk.x * disk.x - y * y, 0.0));
  const vec3 h = disk.x * vec3(0.0, 1.0, 0.0) + y * along + up * stretched;
  return normalize(vec3(alpha * h.xy, max(h.z, 1e-9)));
}

// Albedo without Fresnel, and its part with (1 - v.h)^5. The rim of the disk, where the lobe's tail
// is, is sampled more densely: 1 - u.x^2 is uniform.
vec2 ggx_sample(vec3 v, float alpha, vec2 u) {
  const vec3 h = visible_normal(v, alpha, vec2(1.0 - u.x * u.x, u.y));
  const float v_h = dot(v, h);
  const float n_l = 2.0 * v_h * h.z - v.z;
  if (!(n_l > 0.0)) return vec2(0.0);
  const float a2 = alpha * alpha;
  const float slant_v = sqrt(v.z * v.z * (1.0 - a2) + a2);
  const float slant_l = sqrt(n_l * n_l * (1.0 - a2) + a2);
  // G2 / G1(v)
  const float share = 2.0 * u.x * n_l * (v.z + slant_v) / (n_l * slant_v + v.z * slant_l);
  return share * vec2(1.0, schlick_weight(v_h));
}

// Of a light from azimuth 2 pi u.y and cosine 1 - u.x^2, which crowds at grazing angles.
float sheen_sample(vec3 v, float alpha, vec2 u) {
  const float n_l = 1.0 - u.x * u.x;
  const float sine = sqrt(max(1.0 - n_l * n_l, 0.0));
  const vec3 l = vec3(sine * sin_cos(2.0 * pi * u.y).yx, n_l);
  const vec3 h = normalize(l + v);
  return charlie_distribution(dot(h.xy, h.xy), alpha) * cloth_visibility(n_l, v.z) * n_l * 4.0 * pi *
         u.x;
}

void main() {
  const uint entry = gl_GlobalInvocationID.x;
  if (entry >= albedo_side * albedo_side) return;
  const float roughness = max(float(entry / albedo_side) / float(albedo_side - 1u), 1.0 / 64.0);
  const float alpha = roughness * roughness;
  const float root = float(entry % albedo_side) / float(albedo_side - 1u);
  const float n_v = albedo_cosine(entry % albedo_side, alpha);
  const float sheen_alpha = max(alpha, 0.04);  // sharper ones vary too fast for the table
  const vec3 v = toward(n_v);
  const vec3 sheen_v = toward(max(root * root, 0.001));
  vec3 sum = vec3(0.0);
  for (uint row = 0u; row < args.samples; ++row) {
    vec3 row_sum = vec3(0.0);
    for (uint column = 0u; column < args.samples; ++column) {
      const vec2 u = (vec2(column, row) + 0.5) / float(args.samples);
      row_sum += vec3(ggx_sample(v, alpha, u), sheen_sample(sheen_v, sheen_alpha, u));
    }
    sum += row_sum / float(args.samples);
  }
  sum /= float(args.samples);
  const float mean_cosine = 1.0 - pow(sum.y / sum.x, 0.2);  // that of Schlick's mean weight
  args.table.at[entry] = vec4(sum.x, max(mean_cosine - n_v, 0.0), 0.0, sum.z);
}
