#pragma once

#include <cmath>
#include <functional>

#include "geometry/math.h"

namespace parity {

/// Does a squeeze matrix do what notes 2.6 derive: x' = n x / (-z), and z = -n and z = -f stay?
/// Checklist row 33.
inline bool squeezes_the_frustum(const std::function<dmat4(double near, double far)>& squeeze) {
  const double near = 1.0, far = 10.0;
  const dmat4 matrix = squeeze(near, far);
  const auto image = [&](dvec3 p) {
    const dvec4 q = matrix * dvec4(p, 1.0);
    return dvec3(q) / q.w;
  };
  const double tolerance = 1e-14 * far;  // some ten roundings of numbers up to f
  const auto is_close = [&](dvec3 a, dvec3 b) { return glm::length(a - b) <= tolerance; };
  return is_close(image({0.5, -0.25, -near}), {0.5, -0.25, -near}) &&
         is_close(image({5.0, 2.0, -far}), {0.5, 0.2, -far});
}

}  // namespace parity
