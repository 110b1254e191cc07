#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "geometry/math.h"
#include "tests/setting.h"

/// What the records of the transform chapter share.
namespace parity::transform_test {

constexpr double u = 0x1p-24;  ///< relative rounding error of one float operation

/// How many matrices or quaternions; 131 and 4099 divide by nothing.
inline Axis count_axis() {
  return {
      .name = "count", .low = 1, .high = 4099, .standard = 131, .logarithmic = true, .whole = true};
}

/// Largest |got - want| over all elements of all matrices, each matrix divided by its own largest
/// element, but at least 1: errors of a matrix grow with what its elements are sums of.
template <typename Matrix>
double matrix_distance(const std::vector<Matrix>& got, const std::vector<Matrix>& want) {
  double largest = 0;
  for (std::size_t k = 0; k < want.size(); ++k) {
    double scale = 1;
    double apart = 0;
    for (int c = 0; c < Matrix::length(); ++c)
      for (int r = 0; r < Matrix::col_type::length(); ++r) {
        scale = std::max(scale, std::abs(double(want[k][c][r])));
        apart = std::max(apart, std::abs(double(got[k][c][r]) - double(want[k][c][r])));
      }
    largest = std::max(largest, apart / scale);
  }
  return largest;
}

/// Largest relative error of any element by itself; an element that must be 0 must be 0.
template <typename Matrix>
double element_distance(const std::vector<Matrix>& got, const std::vector<Matrix>& want) {
  double largest = 0;
  for (std::size_t k = 0; k < want.size(); ++k)
    for (int c = 0; c < Matrix::length(); ++c)
      for (int r = 0; r < Matrix::col_type::length(); ++r) {
        const double apart = std::abs(double(got[k][c][r]) - double(want[k][c][r]));
        if (apart == 0) continue;
        largest = std::max(largest, want[k][c][r] == 0 ? std::numeric_limits<double>::infinity()
                                                       : apart / std::abs(double(want[k][c][r])));
      }
  return largest;
}

/// Doubles of an answer in floats.
template <typename To, typename From>
std::vector<To> widened(const std::vector<From>& values) {
  return {values.begin(), values.end()};
}

}  // namespace parity::transform_test
