// Part of the light that a smooth border reflects. `cosine` is that between the light and the normal
// of the border, which for microfacets is the half vector. Source: notes 5.4, 6.2.
#ifndef PARITY_SHADING_FRESNEL_GLSL
#define PARITY_SHADING_FRESNEL_GLSL

// (1 - cosine)^5 of a clamped cosine.
float schlick_weight(float cosine) {
  const float grazing = 1.0 - clamp(cosine, 0.0, 1.0);
  const float grazing2 = grazing * grazing;
  return grazing2 * grazing2 * grazing;
}

// Source: Schlick 1994.
vec3 fresnel_of_schlick(vec3 f0, float cosine) { return f0 + (1.0 - f0) * schlick_weight(cosine); }

// Unpolarised, from outside: eta >= 1 is the index inside over that outside.
float fresnel_of_dielectric(float eta, float cosine) {
  const float c = clamp(cosine, 0.0, 1.0);
  const float t = sqrt(max(1.0 - (1.0 - c * c) / (eta * eta), 0.0));
  const float s_wave = (c - eta * t) / (c + eta * t);
  const float p_wave = (eta * c - t) / (eta * c + t);
  return 0.5 * (s_wave * s_wave + p_wave * p_wave);
}

// One wavelength of a metal with the complex index eta + i k. Of the two roots of a quadratic the
// one without cancellation is taken and the other one follows from their product.
// Source: Born & Wolf, "Principles of Optics", 14.2.
float fresnel_of_conductor(float eta, float k, float cosine) {
  const float c = clamp(cosine, 0.0, 1.0);
  const float sine2 = 1.0 - c * c;
  const float real = (eta - k) * (eta + k) - sine2;
  const float mixed = 2.0 * eta * k;
  const float modulus = sqrt(real * real + mixed * mixed);  // a^2 + b^2
  const float larger = 0.5 * (modulus + abs(real));
  const float a = sqrt(real >= 0.0 ? larger : mixed * mixed / (4.0 * larger));
  const float s_wave = (modulus + c * c - 2.0 * a * c) / (modulus + c * c + 2.0 * a * c);
  const float product = c * c * modulus + sine2 * sine2;
  const float p_over_s = (product - 2.0 * a * c * sine2) / (product + 2.0 * a * c * sine2);
  return 0.5 * s_wave * (1.0 + p_over_s);
}
#endif
