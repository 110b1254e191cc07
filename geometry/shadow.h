#pragma once

#include <array>
#include <vector>

#include "geometry/grid.h"
#include "geometry/math.h"

namespace parity {

/// Shadow maps of a directional light and what asks them.
struct ShadowProblem {
  std::vector<vec4> points;               ///< world, and the distance along the view
  std::array<mat4, 4> shadow_from_world;  ///< affine: x, y of the map 0 to 1, z depth
  std::array<Grid<float>, 4> depths;      ///< squares of one size
  vec4 ends{0.0f};                        ///< distances at which the cascades end, ascending
  int radius = 1;                         ///< texels; the filter is 2 radius + 1 wide
  float bias = 0;                         ///< depth
};

/// Distances at which `count` cascades end: between equal steps (0) and equal ratios (1).
///
/// Source: Zhang et al. 2006, "Parallel-Split Shadow Maps".
std::vector<double> cascade_ends(double near, double far, int count, double logarithmic);

}  // namespace parity
