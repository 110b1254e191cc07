#version 460
#include "raster/tile_bins.glsl"

// Counts the tiles of a piece; one thread a piece that there is room for, and one more that ends the
// prefix sum. Source: notes 1.5.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { TileCountArgs args; };

uint count_tiles(TrianglePiece t) {
  const TileBox box = tile_box(t, args.target);
  uint count = 0u;
  for (int y = box.first.y; y <= box.last.y; ++y)
    for (int x = box.first.x; x <= box.last.x; ++x)
      count += touches_tile(t, ivec2(x, y), args.target.samples) ? 1u : 0u;
  return count;
}

void main() {
  const uint piece = gl_GlobalInvocationID.x;
  if (piece > args.capacity) return;
  uint count = 0u;
  if (piece < min(args.piece_count.at[0], args.capacity)) count = count_tiles(args.pieces.at[piece]);
  args.counts.at[piece] = count;
}
