#version 460
#include "numerics/layout.h"
#include "fluid/layout.h"

// Where the particles of each cell begin and end among the sorted; one thread a particle.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { LiquidArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  const uint key = args.keys.at[i];
  if (i == 0u || args.keys.at[i - 1u] != key) args.ranges.at[2u * key] = i;
  if (i + 1u == args.count || args.keys.at[i + 1u] != key) args.ranges.at[2u * key + 1u] = i + 1u;
}
