// The transfer function of sRGB without a power: polynomials in roots, off by less than a 400th of
// an 8-bit code where a value is stored. Source: IEC 61966-2-1; the coefficients interpolate
// t^0.4 and q^(5/3) at Chebyshev nodes.
#ifndef PARITY_TEXTURE_SRGB_CURVE_GLSL
#define PARITY_TEXTURE_SRGB_CURVE_GLSL

// Linear light of display values 0 to 1 that are codes / 255. t^2.4 = t^2 s^0.8 with s = sqrt(t).
// Relative error less than 1.2e-4, at most 0.0022 codes.
vec3 linear_from_srgb_curve(vec3 c) {
  const vec3 t = (c + 0.055) * (1.0 / 1.055);
  const vec3 s = sqrt(t);
  const vec3 p =
      0.044731587 + s * (1.255846 + s * (-0.5267212 + s * (0.30826017 + s * -0.08213561)));
  return mix(t * t * p, c * (1.0 / 12.92), lessThanEqual(c, vec3(0.04045)));
}

// 255 times the display value of linear light 0 to 1. x^(1/2.4) = q^(5/3) with q = x^(1/4).
// Error less than 0.0026 codes.
vec3 srgb_code_curve(vec3 x) {
  const vec3 q = sqrt(sqrt(x));
  const vec3 p = -15.715575 +
                 q * (42.06837 + q * (317.27457 +
                                      q * (-142.17670 + q * (69.551819 + q * -16.003542))));
  return mix(p, x * (255.0 * 12.92), lessThanEqual(x, vec3(0.0031308)));
}
#endif
