// The transfer function of sRGB without a power, for values from 0 to 255: polynomials, least in
// the largest error, off by less than a seventieth of a code where a value is stored. Source: IEC
// 61966-2-1; the coefficients are minimax fits of ((c + 0.055) / 1.055)^2.4 and q^(5/3).
#ifndef PARITY_TEXTURE_SRGB_CURVE_GLSL
#define PARITY_TEXTURE_SRGB_CURVE_GLSL

// 255 times the linear light of whole codes 0 to 255. Error at most 0.0118 codes; of means of such
// values too, as the slope of the curve is concave in linear light.
vec3 linear_from_srgb_curve(vec3 code) {
  const vec3 p =
      0.235682398 +
      code * (0.0325712813 +
              code * (0.00204165018 +
                      code * (1.02067079e-5 + code * (-1.82912699e-8 + code * 2.02427824e-11))));
  return mix(p, code * (1.0 / 12.92), lessThan(code, vec3(10.5)));
}

// The code of 255 times linear light. x^(1/2.4) = q^(5/3) with q = x^(1/4). Error less than 0.0017
// codes.
vec3 srgb_code_curve(vec3 x) {
  const vec3 q = sqrt(sqrt(x));
  const vec3 p = -15.641755 +
                 q * (10.3392856 + q * (20.0472017 +
                                        q * (-2.30767231 + q * (0.289533122 + q * -0.017053515))));
  return mix(p, x * 12.92, lessThanEqual(x, vec3(255.0 * 0.0031308)));
}
#endif
