#version 460
#include "texture/displacement.glsl"

// The corners of the small triangles; one thread each. Source: notes 6.3.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { DisplacementArgs args; };

// The triangle that small triangle `index` is a part of: the last that begins at or before it.
uint parent_of(uint index) {
  uint low = 0u;
  uint high = args.count;
  [[dont_unroll]] while (high - low > 1u) {
    const uint middle = (low + high) / 2u;
    if (args.begins.at[middle] <= index) low = middle;
    else high = middle;
  }
  return low;
}

void main() {
  const uint index = gl_GlobalInvocationID.x;
  if (index >= args.small_count) return;
  const uint parent = parent_of(index);
  const uint k = index - args.begins.at[parent];
  uint row = uint(sqrt(float(k)));
  row -= row * row > k ? 1u : 0u;
  const uint column = k - row * row;  // of 2 row + 1 triangles, every other one upside down
  const uint left = column / 2u;
  const bool down = (column & 1u) != 0u;
  [[dont_unroll]] for (uint c = 0u; c < 3u; ++c) {
    const uint at_row = c == 0u || (c == 2u && down) ? row : row + 1u;
    const uint at_column = c == 0u || (c == 1u && !down) ? left : left + 1u;
    args.corners.at[3u * index + c] =
        displaced(args, lattice_vertex(args, parent, at_row, at_column));
  }
}
