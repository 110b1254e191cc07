#version 460
#include "sph/layout.h"

// Sum and largest of the compression of a block, in order; one thread a block.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { SolveCheckArgs args; };

void main() {
  const uint block = gl_GlobalInvocationID.x;
  const uint first = block * args.block;
  if (first >= args.count || args.solver.at[0].running == 0u) return;
  const uint last = min(first + args.block, args.count);
  precise float sum = 0.0;
  float largest = 0.0;
  for (uint i = first; i < last; ++i) {
    const float compression = args.moved.at[i].w;
    sum += compression;
    largest = max(largest, compression);
  }
  args.sums.at[block] = vec2(sum, largest);
}
