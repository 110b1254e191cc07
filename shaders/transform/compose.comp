#version 460
#include "transform/layout.h"
#include "transform/compose.glsl"

// Parent from node; one thread a transform. Source: notes 2.4.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { ComposeArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  args.results.at[i] = compose(args.inputs.at[i]);
}
