// Linear light to sRGB codes. Source: IEC 61966-2-1; Khronos Data Format, "sRGB EOTF".
#ifndef PARITY_RASTER_SRGB_GLSL
#define PARITY_RASTER_SRGB_GLSL

#include "raster/layout.h"

/// The nearest code of a linear value. pow only guesses, off by one at most; the exact borders of
/// the codes decide. NaN is 0.
uint srgb_code(float linear, REF(float) thresholds) {
  if (!(linear > 0.0)) return 0u;
  if (linear >= 1.0) return 255u;
  const float guess =
      linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
  uint code = uint(clamp(255.0 * guess + 0.5, 0.0, 255.0));
  if (linear < thresholds.at[code]) return code - 1u;
  if (code < 255u && linear >= thresholds.at[code + 1u]) return code + 1u;
  return code;
}

/// Alpha is linear: rounded half up.
uint unorm_code(float value) {
  if (!(value > 0.0)) return 0u;
  precise float scaled = min(value, 1.0) * 255.0 + 0.5;
  return uint(scaled);
}

uint srgb_codes(vec4 color, REF(float) thresholds) {
  return srgb_code(color.r, thresholds) | srgb_code(color.g, thresholds) << 8 |
         srgb_code(color.b, thresholds) << 16 | unorm_code(color.a) << 24;
}

#endif
