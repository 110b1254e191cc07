// Translation after rotation after scale. Source: notes 2.1, 2.4.
#ifndef PARITY_TRANSFORM_COMPOSE_GLSL
#define PARITY_TRANSFORM_COMPOSE_GLSL

#include "transform/layout.h"
#include "transform/quaternion.glsl"

mat4 compose(TrsRecord trs) {
  const mat3 rotation = quaternion_matrix(trs.rotation);
  precise mat4 m = mat4(vec4(rotation[0] * trs.scale.x, 0.0), vec4(rotation[1] * trs.scale.y, 0.0),
                        vec4(rotation[2] * trs.scale.z, 0.0), vec4(trs.translation, 1.0));
  return m;
}

#endif
