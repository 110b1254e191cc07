#version 460
#include "transform/layout.h"
#include "transform/quaternion.glsl"

// Turns a vector by a unit quaternion; one thread a pair. Source: notes 2.7.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { QuaternionRotateArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  args.results.at[i] = quaternion_rotate(args.quaternions.at[i], args.vectors.at[i]);
}
