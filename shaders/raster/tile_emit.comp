#version 460
#include "raster/tile_bins.glsl"

// Writes the (tile, piece) pairs of a piece where the prefix sum says; one thread a piece.
// Source: notes 1.5.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { TileEmitArgs args; };

void main() {
  const uint piece = gl_GlobalInvocationID.x;
  if (piece >= min(args.piece_count.at[0], args.capacity)) return;
  const TrianglePiece t = args.pieces.at[piece];
  const TileBox box = tile_box(t, args.target);
  uint at = args.offsets.at[piece];
  for (int y = box.first.y; y <= box.last.y; ++y)
    for (int x = box.first.x; x <= box.last.x; ++x)
      if (touches_tile(t, ivec2(x, y), args.target.samples)) {
        if (at < args.pair_capacity) {
          args.keys.at[at] = uint(y) * args.target.tiles_x + uint(x);
          args.values.at[at] = piece;
        }
        ++at;
      }
}
