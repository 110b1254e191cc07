#version 460
#include "sph/layout.h"

// Values in sorted order; one thread a particle.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { GatherArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  args.to.at[i] = args.from.at[args.ids.at[i]];
}
