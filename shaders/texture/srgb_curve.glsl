// The transfer function of sRGB without a power: polynomials, off by less than a sixtieth of an
// 8-bit code where a value is stored. Source: IEC 61966-2-1; the coefficients interpolate
// ((c + 0.055) / 1.055)^1.2 and q^(5/3) at Chebyshev nodes.
#ifndef PARITY_TEXTURE_SRGB_CURVE_GLSL
#define PARITY_TEXTURE_SRGB_CURVE_GLSL

// Linear light of display values 0 to 1 that are codes / 255. Error at most 0.0155 codes of the
// display value; of means of such values too, as the slope of the curve is concave in linear light.
vec3 linear_from_srgb_curve(vec3 c) {
  const vec3 root =
      0.028253138 +
      c * (0.65593553 +
           c * (0.71613693 +
                c * (-0.94714421 + c * (0.99447078 + c * (-0.59974003 + c * 0.15209888)))));
  return mix(root * root, c * (1.0 / 12.92), lessThanEqual(c, vec3(0.04045)));
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
