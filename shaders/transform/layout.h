// What the kernels of the transform chapter and their hosts share. Fields only. Quaternions are
// (x, y, z, w) with w the real part.
#ifndef PARITY_TRANSFORM_LAYOUT_H
#define PARITY_TRANSFORM_LAYOUT_H

#include "../shared.h"

#ifdef __cplusplus
namespace parity {
#endif

struct TrsRecord {
  vec3 translation;
  vec4 rotation;
  vec3 scale;
};
REF_TYPE(TrsRecord, 4)

struct LookAtRecord {
  vec3 eye;
  vec3 center;
  vec3 up;
};
REF_TYPE(LookAtRecord, 4)

struct ViewVolumeRecord {
  float left;
  float right;
  float bottom;
  float top;
  float near;
  float far;  ///< infinite: +inf
};
REF_TYPE(ViewVolumeRecord, 4)

struct SlerpRecord {
  vec4 from;
  vec4 to;
  float t;
};
REF_TYPE(SlerpRecord, 4)

struct ComposeArgs {
  REF(TrsRecord) inputs;
  REF(mat4) results;
  uint count;
  uint padding;
};

struct RotateArgs {
  REF(vec4) inputs;  ///< axis, angle
  REF(mat3) results;
  uint count;
  uint padding;
};

struct LookAtArgs {
  REF(LookAtRecord) inputs;
  REF(mat4) results;
  uint count;
  uint padding;
};

struct ProjectionArgs {
  REF(ViewVolumeRecord) inputs;
  REF(mat4) results;
  uint count;
  uint depth_mode;  ///< parity::DepthMode
};

struct QuaternionMatrixArgs {
  REF(vec4) inputs;
  REF(mat3) results;
  uint count;
  uint padding;
};

struct QuaternionRotateArgs {
  REF(vec4) quaternions;
  REF(vec3) vectors;
  REF(vec3) results;
  uint count;
  uint padding;
};

struct SlerpArgs {
  REF(SlerpRecord) inputs;
  REF(vec4) results;
  uint count;
  uint padding;
};

#ifdef __cplusplus
}  // namespace parity
#endif
#endif
