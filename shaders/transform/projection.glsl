// Clip from view for Vulkan: y down, depth 0 (near) to 1 (far); reverse-Z 1 to 0. Source: notes 2.6;
// Vulkan 1.3, "Coordinate Transformations".
#ifndef PARITY_TRANSFORM_PROJECTION_GLSL
#define PARITY_TRANSFORM_PROJECTION_GLSL

#include "transform/layout.h"

const uint projection_reverse_z = 1u;  // parity::DepthMode

/// (a, b) of z_clip = a z + b w for a depth of 0 at the near plane and 1 at the far one.
vec2 perspective_depth(float near, float far, uint mode) {
  const bool reverse = mode == projection_reverse_z;
  if (isinf(far)) return reverse ? vec2(0.0, near) : vec2(-1.0, -near);
  precise vec2 row = reverse ? vec2(near, far * near) / (far - near)
                             : vec2(-far, -far * near) / (far - near);
  return row;
}

/// Erratum: notes 2.6 squeeze with w' = +z; it is -z. Their full matrix has depth -1 to 1.
mat4 perspective(ViewVolumeRecord v, uint mode) {
  precise vec2 size = vec2(v.right - v.left, v.top - v.bottom);
  precise vec2 scale = 2.0 * v.near / vec2(size.x, -size.y);
  precise vec2 shift = vec2(v.right + v.left, v.bottom + v.top) / vec2(size.x, -size.y);
  const vec2 depth = perspective_depth(v.near, v.far, mode);
  return mat4(vec4(scale.x, 0.0, 0.0, 0.0), vec4(0.0, scale.y, 0.0, 0.0),
              vec4(shift, depth.x, -1.0), vec4(0.0, 0.0, depth.y, 0.0));
}

mat4 orthographic(ViewVolumeRecord v, uint mode) {
  precise vec2 size = vec2(v.right - v.left, v.top - v.bottom);
  precise vec2 scale = 2.0 / vec2(size.x, -size.y);
  precise vec2 shift = vec2(v.right + v.left, v.bottom + v.top) / vec2(-size.x, size.y);
  precise vec2 depth = (mode == projection_reverse_z ? vec2(1.0, v.far) : vec2(-1.0, -v.near)) /
                       (v.far - v.near);
  return mat4(vec4(scale.x, 0.0, 0.0, 0.0), vec4(0.0, scale.y, 0.0, 0.0),
              vec4(0.0, 0.0, depth.x, 0.0), vec4(shift, depth.y, 1.0));
}

#endif
