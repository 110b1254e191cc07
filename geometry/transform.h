#pragma once

#include "geometry/math.h"

/// The problems of the transform chapter: what goes in, on either side.
namespace parity {

/// Translation after rotation after scale.
struct Trs {
  vec3 translation{0.0f};
  quat rotation{1.0f, 0.0f, 0.0f, 0.0f};  ///< unit
  vec3 scale{1.0f};
};

struct AxisAngle {
  vec3 axis{0.0f, 0.0f, 1.0f};  ///< unit
  float angle = 0.0f;           ///< rad
};

struct LookAt {
  vec3 eye{0.0f};
  vec3 center{0.0f, 0.0f, -1.0f};
  vec3 up{0.0f, 1.0f, 0.0f};
};

/// A view volume; the near plane at z = -near in view space. `far` may be infinite if perspective.
struct ViewVolume {
  float left = -1.0f, right = 1.0f, bottom = -1.0f, top = 1.0f;  ///< m, at the near plane
  float near = 1.0f, far = 10.0f;                                ///< m
};

/// Two poses and where between them, 0 to 1.
struct SlerpProblem {
  quat from{1.0f, 0.0f, 0.0f, 0.0f};
  quat to{1.0f, 0.0f, 0.0f, 0.0f};
  float t = 0.0f;
};

}  // namespace parity
