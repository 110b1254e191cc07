#version 460
#include "transform/layout.h"
#include "transform/look_at.glsl"

// View from world; one thread a camera. Source: notes 2.5.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { LookAtArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  args.results.at[i] = look_at(args.inputs.at[i]);
}
