#version 460
#include "raster/tile_bins.glsl"

// Counts the tiles of a triangle, piece by piece; one thread a triangle, and one more that ends the
// prefix sum. Source: notes 1.5.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { TileCountArgs args; };

uint count_tiles(FixedTriangle t) {
  const TileBox box = tile_box(t, args.target);
  uint count = 0u;
  for (int y = box.first.y; y <= box.last.y; ++y)
    for (int x = box.first.x; x <= box.last.x; ++x)
      count += touches_tile(t, ivec2(x, y), args.target.samples) ? 1u : 0u;
  return count;
}

void main() {
  const uint triangle = gl_GlobalInvocationID.x;
  if (triangle > args.source.triangle_count) return;
  uint count = 0u;
  if (triangle < args.source.triangle_count) {
    ClippedRecord polygon;
    const uint pieces = load_pieces(args.source, args.target, triangle, polygon);
    const uint flags = args.source.flags.at[triangle];
    for (uint piece = 0u; piece < pieces; ++piece)
      count += count_tiles(fixed_piece(polygon, piece, flags, args.target));
  }
  args.counts.at[triangle] = count;
}
