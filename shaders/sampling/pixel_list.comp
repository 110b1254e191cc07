#version 460
#include "sampling/layout.h"

// Lists the flagged pixels, from how many are before each; one thread a pixel. Source: Blelloch 1990.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { PixelNeedArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.place_count) return;
  const uint before = args.flags.at[i];
  if (args.flags.at[i + 1u] == before) return;
  const uvec2 tile = uvec2((i / 64u) % args.tiles_x, (i / 64u) / args.tiles_x);
  const uvec2 pixel = tile * 8u + uvec2(i % 8u, (i / 8u) % 8u);
  args.pixels.at[before] = pixel.y * args.width + pixel.x;
}
