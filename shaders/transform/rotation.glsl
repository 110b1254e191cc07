// Rotation about an axis. Source: notes 2.3 (Rodrigues).
#ifndef PARITY_TRANSFORM_ROTATION_GLSL
#define PARITY_TRANSFORM_ROTATION_GLSL

#include "transform/trigonometry.glsl"

/// R = I cos + [k]x sin + k k^T (1 - cos), columns; 1 - cos as 2 sin^2 of half the angle.
mat3 axis_rotation(vec3 k, float angle) {
  const vec2 whole = sin_cos(angle);
  const float half_sine = sin_cos(0.5 * angle).x;
  precise float versine = 2.0 * half_sine * half_sine;
  precise vec3 s = whole.x * k;
  precise mat3 m = mat3(whole.y + versine * k.x * k.x, versine * k.x * k.y + s.z,
                        versine * k.x * k.z - s.y, versine * k.x * k.y - s.z,
                        whole.y + versine * k.y * k.y, versine * k.y * k.z + s.x,
                        versine * k.x * k.z + s.y, versine * k.y * k.z - s.x,
                        whole.y + versine * k.z * k.z);
  return m;
}

#endif
