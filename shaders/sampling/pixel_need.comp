#version 460
#include "sampling/layout.h"

// Finds the pixels that differ from a neighbour by more than the contrast, on a screen. Of those
// that differ by less, the mean over the pixel follows from the middles around it. One thread a row
// of a tile. Source: notes 1.8; Mitchell 1987. The mean of a smooth f over a square of side 1 is
// f + (f_xx + f_yy) / 24 and terms of the fourth order.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { PixelNeedArgs args; };

uint index_of(ivec2 pixel) {
  const ivec2 inside = clamp(pixel, ivec2(0), ivec2(args.width, args.height) - 1);
  return uint(inside.y) * args.width + uint(inside.x);
}

vec4 radiance(ivec2 pixel) {
  const uint i = index_of(pixel);
  return vec4(unpackHalf2x16(args.words.at[2u * i]), unpackHalf2x16(args.words.at[2u * i + 1u]));
}

vec4 mean_around(ivec2 pixel) {
  const vec4 across = radiance(pixel - ivec2(1, 0)) + radiance(pixel + ivec2(1, 0));
  const vec4 down = radiance(pixel - ivec2(0, 1)) + radiance(pixel + ivec2(0, 1));
  const vec4 here = radiance(pixel);
  return here + (across + down - 4.0 * here) / 24.0;
}

// The least and the largest of each channel's codes.
struct Range {
  uvec4 low;
  uvec4 high;
};

Range joined(Range a, Range b) { return Range(min(a.low, b.low), max(a.high, b.high)); }

Range code_range(ivec2 pixel) {
  const uint code = args.codes.at[index_of(pixel)];
  const uvec4 channels = uvec4(code, code >> 8u, code >> 16u, code >> 24u) & 255u;
  return Range(channels, channels);
}

Range column_range(ivec2 pixel) {
  return joined(code_range(pixel), joined(code_range(pixel - ivec2(0, 1)), code_range(pixel + ivec2(0, 1))));
}

void write_mean(ivec2 pixel) {
  const vec4 mean = mean_around(pixel);
  const uint at = index_of(pixel);
  args.averages.at[2u * at] = packHalf2x16(mean.xy);
  args.averages.at[2u * at + 1u] = packHalf2x16(mean.zw);
}

void main() {
  const uint row = gl_GlobalInvocationID.x;
  if (row >= args.row_count) return;
  const uvec2 tile = uvec2((row / 8u) % args.tiles_x, (row / 8u) / args.tiles_x);
  const ivec2 first = ivec2(tile.x * 8u, tile.y * 8u + row % 8u);
  uint mask = 0u;
  if (first.y < int(args.height)) {
    const int end = min(8, int(args.width) - first.x);
    Range left = column_range(first - ivec2(1, 0)), middle = column_range(first);
    for (int x = 0; x < end; ++x) {
      const Range right = column_range(first + ivec2(x + 1, 0));
      const Range around = joined(left, joined(middle, right));
      const uvec4 range = around.high - around.low;
      const uint largest = max(max(range.x, range.y), max(range.z, range.w));
      if (float(largest) > 255.0 * args.contrast)
        mask |= 1u << x;
      else if (largest > 0u)
        write_mean(first + ivec2(x, 0));
      left = middle;
      middle = right;
    }
  }
  args.masks.at[row] = mask;
  args.counts.at[row] = uint(bitCount(mask));
}
