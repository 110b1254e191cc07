#pragma once

#include <cmath>

namespace parity {

/// The transfer function of sRGB, exact in its two pieces: a display value in [0, 1] for a linear
/// one in [0, 1]. Negative values follow the straight piece, values above 1 the curve.
///
/// Source: IEC 61966-2-1.
inline double srgb_from_linear(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

/// The inverse of srgb_from_linear: a linear value in [0, 1] for a display value in [0, 1].
///
/// Source: IEC 61966-2-1.
inline double linear_from_srgb(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

/// The same, computed in double and rounded once.
inline float srgb_from_linear(float linear) { return float(srgb_from_linear(double(linear))); }
inline float linear_from_srgb(float srgb) { return float(linear_from_srgb(double(srgb))); }

}  // namespace parity
