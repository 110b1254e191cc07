#version 460
#include "sampling/layout.h"

// Flags the pixels that differ from a neighbour by more than the contrast, on a screen; one thread a
// pixel. Source: notes 1.8; Mitchell 1987.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { PixelNeedArgs args; };

// What a screen shows of light, roughly: gamma 2, clipped.
vec3 displayed(ivec2 pixel) {
  const ivec2 inside = clamp(pixel, ivec2(0), ivec2(args.width, args.height) - 1);
  return sqrt(clamp(args.colors.at[inside.y * int(args.width) + inside.x].rgb * args.gain, 0.0, 1.0));
}

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.place_count) return;
  const uvec2 tile = uvec2((i / 64u) % args.tiles_x, (i / 64u) / args.tiles_x);
  const ivec2 pixel = ivec2(tile * 8u + uvec2(i % 8u, (i / 8u) % 8u));
  if (pixel.x >= int(args.width) || pixel.y >= int(args.height)) {
    args.flags.at[i] = 0u;
    return;
  }
  vec3 low = vec3(1.0), high = vec3(0.0);
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      const vec3 shown = displayed(pixel + ivec2(x, y));
      low = min(low, shown);
      high = max(high, shown);
    }
  const vec3 range = high - low;
  args.flags.at[i] = max(range.r, max(range.g, range.b)) > args.contrast ? 1u : 0u;
}
