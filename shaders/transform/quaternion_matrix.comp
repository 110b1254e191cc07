#version 460
#include "transform/layout.h"
#include "transform/quaternion.glsl"

// Matrix of a unit quaternion; one thread a quaternion. Source: notes 2.7.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { QuaternionMatrixArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  args.results.at[i] = quaternion_matrix(args.inputs.at[i]);
}
