// Distributions of microfacets and what they hide of each other (Smith, height-correlated).
// Directions stand in the frame of the surface: z is the normal, x the tangent.
// Source: notes 6.2; Walter et al. 2007; Heitz 2014.
#ifndef PARITY_SHADING_MICROFACET_GLSL
#define PARITY_SHADING_MICROFACET_GLSL

const float pi = 3.14159265358979;

// GGX. `slope2` is (h.x / alpha.x)^2 + (h.y / alpha.y)^2.
float ggx_distribution(float slope2, float cosine, float alpha_product) {
  const float t = slope2 + cosine * cosine;
  return 1.0 / (pi * alpha_product * t * t);
}

// The same of an isotropic surface in any frame. 1 - (n.h)^2 is taken from the cross product: the
// difference would lose all digits at small roughness.
float ggx_distribution(vec3 n, vec3 h, float alpha) {
  const float cosine = dot(n, h);
  if (!(cosine > 0.0)) return alpha * alpha / pi;  // as at the horizon
  const vec3 sine = cross(n, h);
  return ggx_distribution(dot(sine, sine) / (alpha * alpha), cosine, alpha * alpha);
}

float beckmann_distribution(float slope2, float cosine, float alpha_product) {
  const float cosine2 = cosine * cosine;
  return exp(-slope2 / cosine2) / (pi * alpha_product * cosine2 * cosine2);
}

// exp(a^2) erfc(a) for a >= 0, to 1.5e-7 exp(a^2). Source: Abramowitz & Stegun 7.1.26.
float scaled_erfc(float a) {
  const float t = 1.0 / (1.0 + 0.3275911 * a);
  return t * (0.254829592 +
              t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 + t * 1.061405429))));
}

// Smith's Lambda of Beckmann's distribution; `a` is cot(theta) / alpha.
float beckmann_lambda(float a) {
  return exp(-a * a) * (0.28209479177 / a - 0.5 * scaled_erfc(a));
}

// G2 / (4 n.l n.v) of GGX. `slant` is |(alpha.x d.x, alpha.y d.y, d.z)| of a direction.
float ggx_visibility(float n_l, float n_v, float slant_l, float slant_v) {
  return 0.5 / (n_l * slant_v + n_v * slant_l);
}

// The same of an isotropic surface.
float smith_visibility(float n_l, float n_v, float alpha) {
  const float a2 = alpha * alpha;
  return ggx_visibility(n_l, n_v, sqrt(n_l * n_l * (1.0 - a2) + a2),
                        sqrt(n_v * n_v * (1.0 - a2) + a2));
}

float beckmann_visibility(vec3 l, vec3 v, vec2 alpha) {
  const float a_l = l.z / max(length(alpha * l.xy), 1e-20);
  const float a_v = v.z / max(length(alpha * v.xy), 1e-20);
  return 0.25 / (l.z * v.z * (1.0 + beckmann_lambda(a_l) + beckmann_lambda(a_v)));
}

// Cloth: microfibres that stand on end. Source: Estevez & Kulla 2017; KHR_materials_sheen.
float charlie_distribution(float sine2, float alpha) {
  const float inverse = 1.0 / alpha;
  return (2.0 + inverse) * pow(max(sine2, 1e-7), 0.5 * inverse) / (2.0 * pi);
}

// Source: Neubelt & Pettineo 2013, in place of the fitted shadowing of the paper.
float cloth_visibility(float n_l, float n_v) { return 1.0 / (4.0 * (n_l + n_v - n_l * n_v)); }
#endif
