#pragma once

#include <cmath>
#include <functional>
#include <numbers>

#include "geometry/transform.h"

namespace parity {

/// Rotation angle of the unit quaternion q, rad, 0 to pi.
inline double rotation_angle(dquat q) {
  return 2.0 * std::atan2(glm::length(dvec3(q.x, q.y, q.z)), std::abs(q.w));
}

/// Does an interpolation of poses take the shorter arc whichever of q and -q it is given, and
/// survive equal poses? Poses 60 degrees apart about z, one of them negated. Checklist row 39.
inline bool takes_the_shortest_arc(const std::function<dquat(const SlerpProblem&)>& slerp) {
  const float half = std::numbers::pi_v<float> / 6.0f;
  const quat start{1.0f, 0.0f, 0.0f, 0.0f};
  const quat end{-std::cos(half), 0.0f, 0.0f, -std::sin(half)};
  double turned = 0.0;
  dquat last{start};
  for (int i = 1; i <= 60; ++i) {
    const dquat pose = slerp({start, end, float(i) / 60.0f});
    turned += rotation_angle(pose * glm::conjugate(last));
    last = pose;
  }
  const dquat still = slerp({start, start, 0.5f});
  const double sixty_degrees = std::numbers::pi / 3.0;
  // The pose is given in float: 2^-24 of an angle of order 1, twice for the double angle.
  return std::abs(turned - sixty_degrees) < 4.0 * 0x1p-24 && std::isfinite(still.w);
}

}  // namespace parity
