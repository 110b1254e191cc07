#pragma once

#include <vector>

#include "geometry/shadow.h"

namespace parity::cpu {

/// Share of the light that reaches each point: 1 where no cascade reaches.
///
/// Which texels hide a point is decided in single precision, as the device does; the filter is the
/// exact area of a box of 2 radius + 1 texels about the place, over texels whose depth is at least
/// that of the point less the bias. Outside of the map nothing hides.
///
/// Stable iff bias >= |slope| (radius + 1) texels (see the map shading/shadow_acne).
///
/// Source: notes 6.1; Williams 1978; Reeves et al. 1987; Zhang et al. 2006.
std::vector<double> shadow_map(const ShadowProblem& problem);

/// The same for one place of one map, 0 to 1, and a depth to which the bias has been applied.
double shadow_filter(const Grid<float>& map, const vec2& place, float depth, int radius);

/// Where a light's map is asked, in the world, and by how much that may be off.
struct ShadowQuery {
  dvec3 position{0.0};
  dvec3 normal{0.0};          ///< unit, of the surface without normal map
  dvec3 position_error{0.0};  ///< each component, m
  double normal_error = 0;
  dvec3 origin{0.0};  ///< to which a device keeps its positions relative
};

/// Share of a light, and what a right device may find.
struct Visibility {
  double value = 1;
  double low = 1;
  double high = 1;
};

/// How much of a light of a frame reaches a point; nothing hides beyond the sides of a map or the
/// last cascade. A receiver is moved along its normal by LightShadow::lift, so that a plane never
/// hides itself.
///
/// Source: notes 6.1; Holbert 2011.
Visibility visibility(const LightShadow& shadow, const ShadowQuery& query);

}  // namespace parity::cpu
