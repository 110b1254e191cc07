#version 460
#include "raster/layout.h"

// Where the list of each tile begins among the sorted pairs: a binary search; one thread a tile, and
// one more for the end.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { TileRangeArgs args; };

void main() {
  const uint tile = gl_GlobalInvocationID.x;
  if (tile > args.tile_count) return;
  uint first = 0u, last = min(args.pair_count.at[0], args.capacity);
  while (first < last) {
    const uint middle = (first + last) >> 1;
    if (args.keys.at[middle] < tile)
      first = middle + 1u;
    else
      last = middle;
  }
  args.begins.at[tile] = first;
}
