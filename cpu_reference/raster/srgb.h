#pragma once

#include "geometry/raster.h"

namespace parity::cpu {

/// The sRGB code of a linear value in 0..1: 12.92 c up to 0.0031308, 1.055 c^(1/2.4) - 0.055 above.
double srgb_from_linear(double linear);

/// A linear picture as one for the screen: times 2^exposure, clamped to 0..1, encoded in sRGB and
/// rounded to the nearest of 256 levels. Alpha is neither exposed nor encoded. NaN becomes 0.
///
/// @param exposure  stops
///
/// Source: IEC 61966-2-1; Khronos Data Format Specification, "sRGB transfer functions".
Grid<u8vec4> encode_srgb(const Grid<vec4>& linear, float exposure);

}  // namespace parity::cpu
