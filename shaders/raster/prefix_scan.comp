#version 460
#include "raster/layout.h"

// Exclusive prefix sums within a block, from the prefix sum of the blocks; one thread a block.
// Source: Blelloch 1990.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { ScanArgs args; };

void main() {
  const uint block = gl_GlobalInvocationID.x;
  const uint first = block * args.block;
  if (first >= args.count) return;
  const uint last = min(first + args.block, args.count);
  uint sum = 0u;
  if (block > 0u) sum = args.sums.at[block];
  for (uint i = first; i < last; ++i) {
    const uint value = args.values.at[i];
    args.values.at[i] = sum;
    sum += value;
  }
}
