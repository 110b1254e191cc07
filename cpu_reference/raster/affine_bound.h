#pragma once

#include <array>

#include "cpu_reference/raster/interpolate.h"

namespace parity::cpu {

/// How far a device's value of a function that is affine in the window may be from the exact one,
/// anywhere in a triangle; see interpolate_bound for the formula.
class AffineBound {
 public:
  /// @param clip  w > 0
  AffineBound(const std::array<vec4, 3>& clip, int width, int height, Snapping snapping);

  /// @param at_corners  the function's values at the corners of the triangle.
  double operator()(const WindowPlane& function, dvec3 at_corners) const;

 private:
  double width_;
  double height_;
  double snap_;         ///< px, how far a vertex may be moved
  double slenderness_;  ///< (longest edge)^2 / (2 area)
};

}  // namespace parity::cpu
