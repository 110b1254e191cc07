#version 460
#include "transform/layout.h"
#include "transform/rotation.glsl"

// Rotation about an axis; one thread a rotation. Source: notes 2.3.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { RotateArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  const vec4 rotation = args.inputs.at[i];
  args.results.at[i] = axis_rotation(rotation.xyz, rotation.w);
}
