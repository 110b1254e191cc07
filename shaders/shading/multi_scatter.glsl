// What light that leaves the microfacets after more than one bounce adds.
// Source: Kulla & Conty 2017; checklist row 108.
#ifndef PARITY_SHADING_MULTI_SCATTER_GLSL
#define PARITY_SHADING_MULTI_SCATTER_GLSL
#include "shading/fresnel.glsl"
#include "shading/layout.h"

// Cosine of column i of the table for a width alpha, and the column of a cosine. Albedos depend on
// cosine / alpha for smooth surfaces and on the cosine for rough ones.
float albedo_cosine(uint i, float alpha) {
  const float x = float(i) / float(albedo_side - 1u);
  const float k = x * x / (1.0 + alpha);
  return clamp(k * alpha / (1.0 - k), 0.001 * alpha, 1.0);
}

float albedo_column(float cosine, float alpha) {
  return sqrt(cosine * (1.0 + alpha) / (cosine + alpha)) * float(albedo_side - 1u);
}

vec4 albedo_between(ref_vec4 table, float x, float row) {
  const uint i = min(uint(x), albedo_side - 2u);
  const uint j = min(uint(row), albedo_side - 2u);
  const uint at = j * albedo_side + i;
  const float u = x - float(i);
  return mix(mix(table.at[at], table.at[at + 1u], u),
             mix(table.at[at + albedo_side], table.at[at + albedo_side + 1u], u), row - float(j));
}

// Reads the table between its nodes; rows are roughness. The part of white light from everywhere that
// comes back is x F0 + y; z is the mean of x + y over the cosine-weighted hemisphere.
vec3 albedo_at(ref_vec4 table, float cosine, float roughness) {
  const float y = clamp(roughness, 1.0 / 64.0, 1.0);
  const float c = clamp(cosine, 1e-6, 1.0);
  const vec4 at = albedo_between(table, albedo_column(c, y * y), y * float(albedo_side - 1u));
  const float rising = at.x * schlick_weight(c + at.y);
  return vec3(at.x - rising, rising, 1.0 - at.z * at.z);
}

// The part of white light from everywhere that a white sheen sends back; columns are the square root
// of the cosine.
float sheen_albedo_at(ref_vec4 table, float cosine, float roughness) {
  const float last = float(albedo_side - 1u);
  return albedo_between(table, sqrt(clamp(cosine, 0.0, 1.0)) * last, clamp(roughness, 0.2, 1.0) * last).w;
}

// Mean of Schlick's term over the cosine-weighted hemisphere; f90 at grazing angles.
vec3 mean_schlick(vec3 f0, float f90) { return f0 + (f90 - f0) * (1.0 / 21.0); }

// What every further bounce inside multiplies up to, for the mean reflectance of one.
vec3 bounced(vec3 mean_fresnel, float mean_albedo) {
  return mean_fresnel * mean_fresnel * mean_albedo / (1.0 - mean_fresnel * (1.0 - mean_albedo));
}

// The missing BRDF, 1/sr. The table's albedos of both directions.
vec3 multi_scatter(vec3 toward_light, vec3 toward_eye, vec3 f0, float f90) {
  const float lost_l = 1.0 - (toward_light.x + toward_light.y);
  const float lost_v = 1.0 - (toward_eye.x + toward_eye.y);
  const float mean = toward_eye.z;
  const float lobe = lost_l * lost_v / (3.14159265358979 * max(1.0 - mean, 1e-6));
  return lobe * bounced(mean_schlick(f0, f90), mean);
}
#endif
