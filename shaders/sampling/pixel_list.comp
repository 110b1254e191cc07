#version 460
#include "sampling/layout.h"

// Lists the pixels that need more, from how many do in the rows before; one thread a row of a tile.
// Source: Blelloch 1990.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { PixelNeedArgs args; };

void main() {
  const uint row = gl_GlobalInvocationID.x;
  if (row >= args.row_count) return;
  const uvec2 tile = uvec2((row / 8u) % args.tiles_x, (row / 8u) / args.tiles_x);
  const uint first = (tile.y * 8u + row % 8u) * args.width + tile.x * 8u;
  uint at = args.counts.at[row];
  for (uint mask = args.masks.at[row]; mask != 0u; mask &= mask - 1u)
    args.pixels.at[at++] = first + uint(findLSB(mask));
}
