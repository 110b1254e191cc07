#version 460
#include "raster/layout.h"

// The sum of a block; one thread a block. Source: Blelloch 1990.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { ScanArgs args; };

void main() {
  const uint block = gl_GlobalInvocationID.x;
  const uint first = block * args.block;
  if (first >= args.count) return;
  const uint last = min(first + args.block, args.count);
  uint sum = 0u;
  for (uint i = first; i < last; ++i) sum += args.values.at[i];
  args.sums.at[block] = sum;
}
