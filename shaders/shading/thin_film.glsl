// Interference in a thin film. Source: Belcour & Barla 2017, "A Practical Extension to Microfacet Theory
// for the Modeling of Varying Iridescence"; KHR_materials_iridescence.
#ifndef PARITY_SHADING_THIN_FILM_GLSL
#define PARITY_SHADING_THIN_FILM_GLSL
#include "shading/fresnel.glsl"
#include "transform/trigonometry.glsl"

vec3 film_cosine(vec3 x) { return vec3(sin_cos(x.x).y, sin_cos(x.y).y, sin_cos(x.z).y); }

// Fourier transform of the colour matching functions, in linear Rec. 709; path in nm.
vec3 film_sensitivity(float path, vec3 shift) {
  const float phase = path * 6.283185307e-9;
  const float phase2 = phase * phase;
  // Heights of the Gaussians are value sqrt(2 pi variance) / 1.0685e-7.
  const vec3 height = vec3(0.846590002, 1.00022189, 1.00112249);
  const vec3 place = vec3(1.6810e6, 1.7953e6, 2.2084e6);
  vec3 xyz = height * film_cosine(place * phase + shift) *
             exp2(-phase2 * vec3(6.2436956e9, 13.4237003e9, 9.53924388e9));
  xyz.x += 0.153868307 * sin_cos(2.2399e6 * phase + shift.x).y * exp2(-phase2 * 6.53281168e9);
  return vec3(dot(vec3(3.2404542, -1.5371385, -0.4985314), xyz),
              dot(vec3(-0.9692660, 1.8760108, 0.0415560), xyz),
              dot(vec3(0.0556434, -0.2040259, 1.0572252), xyz));
}

// Reflectance of a base of F0 `base` under a film; thickness in nm.
vec3 thin_film(float index, float thickness, float cosine, vec3 base) {
  const float pi = 3.14159265358979;
  const float t = clamp(thickness / 0.03, 0.0, 1.0);
  const float eta = 1.0 + (index - 1.0) * (t * t * (3.0 - 2.0 * t));
  const float inside = sqrt(max(1.0 - (1.0 - cosine * cosine) / (eta * eta), 0.0));
  const float at_normal = (eta - 1.0) / (eta + 1.0);
  const float r0 = at_normal * at_normal;
  const float outer = r0 + (1.0 - r0) * schlick_weight(cosine);
  const float passed = (1.0 - outer) * (1.0 - outer);
  const vec3 root = sqrt(clamp(base, 0.0, 0.9999));
  const vec3 base_index = (1.0 + root) / (1.0 - root);
  const vec3 border = (base_index - eta) / (base_index + eta);
  const vec3 inner = border * border + (1.0 - border * border) * schlick_weight(inside);
  const vec3 shift = pi + pi * vec3(lessThan(base_index, vec3(eta)));
  const vec3 both = clamp(outer * inner, 1e-5, 0.9999);
  const vec3 rest = passed * inner / (1.0 - both);
  const float path = 2.0 * eta * thickness * inside;
  const vec3 round_trip = sqrt(both);
  vec3 sum = outer + rest;
  vec3 weight = rest - (1.0 - outer);
  for (uint m = 1u; m <= 2u; ++m) {
    weight *= round_trip;
    sum += weight * film_sensitivity(float(m) * path, float(m) * shift) * 2.0;
  }
  return clamp(sum, 0.0, 1.0);
}
#endif
