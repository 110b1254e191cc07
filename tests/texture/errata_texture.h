#pragma once

#include <cmath>
#include <functional>
#include <numbers>

#include "geometry/grid.h"
#include "geometry/math.h"

namespace parity {

/// Level of detail from the change of (u, v) over one pixel right and down, in a texture.
using LevelOfDetail = std::function<double(dvec2 uv_dx, dvec2 uv_dy, int width, int height)>;

/// Is it 0 where a texel is a pixel, however the texture is turned, and 1 where one of the two
/// derivatives is twice as long? Checklist row 113.
inline bool measures_texels_a_pixel(const LevelOfDetail& level) {
  const double rounding = 1e-6;  // of a float's logarithm near 0
  const auto is = [&](dvec2 dx, dvec2 dy, double want) {
    return std::abs(level(dx / dvec2(512, 256), dy / dvec2(512, 256), 512, 256) - want) < rounding;
  };
  const double half = std::numbers::sqrt2 / 2;
  return is({1, 0}, {0, 1}, 0) && is({half, half}, {-half, half}, 0) && is({1, 0}, {0, 2}, 1) &&
         is({2, 0}, {0, 1}, 1);
}

/// Value of a row of texels at u in texture lengths.
using LinearFilter = std::function<double(const std::vector<double>& texels, double u)>;

/// Is a ramp read as a ramp: texel i where u W = i + 1/2, halfway between two where u W = i?
/// Checklist row 111.
inline bool reads_a_ramp_as_a_ramp(const LinearFilter& filter) {
  const std::vector<double> ramp{0, 10, 20, 30};
  for (const double place : {0.5, 1.0, 1.25, 2.5, 3.0})
    if (std::abs(filter(ramp, place / 4) - 10 * (place - 0.5)) > 1e-9) return false;
  return true;
}

/// The next mip level of a row of values.
using Halving = std::function<std::vector<double>(const std::vector<double>& row)>;

/// Does a level of floor(W / 2) texels keep the mean of 5 values, and of 4? Checklist row 112.
inline bool keeps_the_mean(const Halving& halve) {
  for (const std::vector<double>& row :
       {std::vector<double>{0, 40, 80, 120, 200}, std::vector<double>{0, 40, 80, 120}}) {
    double before = 0, after = 0;
    for (const double value : row) before += value / double(row.size());
    const std::vector<double> half = halve(row);
    for (const double value : half) after += value / double(half.size());
    if (half.size() != row.size() / 2 || std::abs(after - before) > 0.02) return false;
  }
  return true;
}

/// Texel of a place 0 to 1 in a row of `size`.
using NearestTexel = std::function<int(double u, int size)>;

/// Is there a texel for every place, u = 1 too? Checklist row 110.
inline bool finds_a_texel_everywhere(const NearestTexel& nearest) {
  for (const double u : {0.0, 0.3, 0.999, 1.0}) {
    const int texel = nearest(u, 8);
    if (texel < 0 || texel >= 8 || (u < 1 && texel != int(u * 8))) return false;
  }
  return true;
}

}  // namespace parity
