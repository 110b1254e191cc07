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

/// One map of a light.
struct ShadowCascade {
  dmat4 shadow_from_world{1.0};  ///< x, y of the map 0 to 1 and z depth, all times w
  double end = 0;                ///< distance along the view that it reaches to, m
  double texel = 0;              ///< side of a texel where w is 1, m
  Grid<float> depths;            ///< square; 1: nothing is there
};

/// What hides a light of a frame: shadow maps, the nearest to the viewer first, or a cube of them.
struct LightShadow {
  int light = 0;  ///< of Frame::lights
  dvec3 forward{0.0, 0.0, -1.0};
  double offset = 0;  ///< the distance along the view of p is dot(forward, p) + offset
  std::vector<ShadowCascade> cascades;  ///< 1 to 4, or the 6 of a cube; sides of the maps all alike
  bool is_cube = false;                 ///< maps look along +x, -x, +y, -y, +z, -z and have no ends
  dvec3 center{0.0};                    ///< of the cube: where the light is
  int radius = 1;                       ///< texels; the filter is 2 radius + 1 wide
  float bias = 0;                       ///< depth

  /// How far a receiver is moved along its normal n where w is 1. A plane's depth within reach of
  /// the filter, r + 1 texels t on both axes, is less by (|n_x| + |n_y|) (r + 1) t w / |cos| at
  /// most, where cos is that of n and the ray; a receiver at a height h over it is nearer by h /
  /// |cos|. |n_x| + |n_y| counts as its largest, sqrt 2: surfaces that face the light may be rough.
  double lift(std::size_t cascade) const {
    return 1.4142135623730951 * (radius + 1) * cascades[cascade].texel;
  }
};

/// Distances at which `count` cascades end: between equal steps (0) and equal ratios (1).
///
/// Source: Zhang et al. 2006, "Parallel-Split Shadow Maps".
std::vector<double> cascade_ends(double near, double far, int count, double logarithmic);

}  // namespace parity
