#version 460
#include "raster/layout.h"

// Moves the pairs of a block to their places, in order; one thread a block.
// Source: Satish, Harris & Garland 2009.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { RadixArgs args; };

void main() {
  const uint block = gl_GlobalInvocationID.x;
  if (block >= args.blocks) return;
  const uint count = min(args.count.at[0], args.capacity);
  const uint last = min((block + 1u) * args.block, count);
  for (uint i = block * args.block; i < last; ++i) {
    const uint key = args.keys.at[i];
    const uint digit = (key >> args.shift) & 255u;
    const uint at = args.counters.at[digit * args.blocks + block]++;
    args.sorted_keys.at[at] = key;
    args.sorted_values.at[at] = args.values.at[i];
  }
}
