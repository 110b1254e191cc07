// Phong's and Blinn's highlights as BRDFs, 1/sr, for a white one. Directions point away from the
// surface; z is the normal. Source: notes 6.1; Lewis 1994; Akenine-Moller et al., "Real-Time
// Rendering", 9.8; Giesen 2009, "Phong Normalization Factor Derivation".
#ifndef PARITY_SHADING_PHONG_GLSL
#define PARITY_SHADING_PHONG_GLSL

// Below 0 the lobe ends; x^0 is 1.
float lobe(float cosine, float exponent) { return cosine > 0.0 ? pow(cosine, exponent) : 0.0; }

// About the mirror direction.
float phong_lobe(vec3 l, vec3 v, float exponent) {
  return lobe(v.z * l.z - v.x * l.x - v.y * l.y, exponent);
}

// About the half vector.
float blinn_phong_lobe(vec3 l, vec3 v, float exponent) {
  return lobe(normalize(l + v).z, exponent);
}

// Factors that keep the reflected energy of a white lobe at most 1, and at 1 for large exponents.
float phong_factor(float exponent) { return (exponent + 2.0) * 0.15915494309; }
// The common (n + 8) / 8 pi lets 7 % too much out at n = 8; this is the exact one of normal incidence.
float blinn_phong_factor(float exponent) {
  return (exponent + 2.0) * (exponent + 4.0) * 0.03978873577 / (exponent + exp2(-0.5 * exponent));
}
#endif
