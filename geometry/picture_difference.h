#pragma once

#include "geometry/grid.h"
#include "geometry/math.h"

namespace parity {

/// How far two pictures are apart by arithmetic: over all pixels and the three colours; alpha is
/// not looked at.
struct PictureDifference {
  double mse = 0.0;      ///< mean of the squared differences
  double psnr = 0.0;     ///< 10 log10(1 / mse), dB, for a peak of 1; infinite if mse is 0
  double maximum = 0.0;  ///< of the absolute differences
  int maximum_x = 0;     ///< where that stands first
  int maximum_y = 0;
};

/// Compares two pictures value by value. Equal infinities, and no number on both sides, differ by
/// 0; if only one is finite they differ by infinity.
///
/// @throws std::invalid_argument  sizes differ or are 0.
PictureDifference difference(const Grid<vec4>& a, const Grid<vec4>& b);

}  // namespace parity
