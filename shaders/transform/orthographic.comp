#version 460
#include "transform/layout.h"
#include "transform/projection.glsl"

// Clip from view of a box; one thread a box. Source: notes 2.6.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { ProjectionArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  args.results.at[i] = orthographic(args.inputs.at[i], args.depth_mode);
}
