// Sine and cosine of our own: the built-in ones may be off by 2^-11.
#ifndef PARITY_TRANSFORM_TRIGONOMETRY_GLSL
#define PARITY_TRANSFORM_TRIGONOMETRY_GLSL

/// (sin x, cos x), absolute error below 2^-22 for |x| up to 8192: the angle less quarter turns (pi/2
/// in three parts, of which the first two have 11 bits and multiply exactly), then polynomials on
/// [-pi/4, pi/4]. Source: Cody & Waite 1980; Moshier's Cephes (sinf, cosf).
vec2 sin_cos(float x) {
  const float turns = roundEven(x * 0.6366197723675814);
  precise float r = ((x - turns * 1.5703125) - turns * 4.83751296997e-4) - turns * 7.54978942e-8;
  precise float s = r * r;
  precise float sine =
      r + r * s * (-1.6666654611e-1 + s * (8.3321608736e-3 + s * -1.9515295891e-4));
  precise float cosine =
      1.0 - 0.5 * s + s * s * (4.166664568298827e-2 +
                               s * (-1.388731625493765e-3 + s * 2.443315711809948e-5));
  const int quarter = int(turns) & 3;
  const vec2 turned = (quarter & 1) == 0 ? vec2(sine, cosine) : vec2(cosine, -sine);
  return quarter < 2 ? turned : -turned;
}

#endif
