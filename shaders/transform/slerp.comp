#version 460
#include "transform/layout.h"
#include "transform/quaternion.glsl"

// Between two orientations; one thread a problem. Source: notes 2.7.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { SlerpArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  args.results.at[i] = slerp(args.inputs.at[i].from, args.inputs.at[i].to, args.inputs.at[i].t);
}
