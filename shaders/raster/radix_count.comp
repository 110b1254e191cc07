#version 460
#include "raster/layout.h"

// Counts the digits of a block; one thread a block. Source: Satish, Harris & Garland 2009.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { RadixArgs args; };

void main() {
  const uint block = gl_GlobalInvocationID.x;
  if (block >= args.blocks) return;
  for (uint digit = 0u; digit < 256u; ++digit) args.counters.at[digit * args.blocks + block] = 0u;
  const uint count = min(args.count.at[0], args.capacity);
  const uint last = min((block + 1u) * args.block, count);
  for (uint i = block * args.block; i < last; ++i) {
    const uint digit = (args.keys.at[i] >> args.shift) & 255u;
    ++args.counters.at[digit * args.blocks + block];
  }
}
