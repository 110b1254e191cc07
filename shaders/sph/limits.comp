#version 460
#include "sph/layout.h"
#include "sph/kernel.glsl"

// The largest speed, acceleration and density of a block, and how many of its particles are too
// crowded for their lists; one thread a block. Maxima do not depend on their order.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { LimitsArgs args; };

void main() {
  const uint block = gl_GlobalInvocationID.x;
  const uint first = block * args.block;
  if (first >= args.count) return;
  const uint last = min(first + args.block, args.count);
  const uint capacity = args.constants.at[0].capacity;
  SphLimits limits = SphLimits(0.0, 0.0, 0.0, 0u);
  for (uint i = first; i < last; ++i) {
    limits.speed = max(limits.speed, squared_length(args.motions.at[i].xyz));
    limits.acceleration = max(limits.acceleration, squared_length(args.accelerations.at[i].xyz));
    limits.density = max(limits.density, args.places.at[i].w);
    if (args.counts.at[i].y > capacity) ++limits.crowded;
  }
  args.limits.at[block] = limits;
}
