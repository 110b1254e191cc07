#version 460
#include "raster/tile_bins.glsl"

// Writes the (tile, piece) pairs of a triangle where the prefix sum says; one thread a triangle.
// Source: notes 1.5.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { TileEmitArgs args; };

uint emit_tiles(FixedTriangle t, uint value, uint at) {
  const TileBox box = tile_box(t, args.target);
  for (int y = box.first.y; y <= box.last.y; ++y)
    for (int x = box.first.x; x <= box.last.x; ++x)
      if (touches_tile(t, ivec2(x, y), args.target.samples)) {
        if (at < args.capacity) {
          args.keys.at[at] = uint(y) * args.target.tiles_x + uint(x);
          args.values.at[at] = value;
        }
        ++at;
      }
  return at;
}

void main() {
  const uint triangle = gl_GlobalInvocationID.x;
  if (triangle >= args.source.triangle_count) return;
  ClippedRecord polygon;
  const uint pieces = load_pieces(args.source, args.target, triangle, polygon);
  const uint flags = args.source.flags.at[triangle];
  uint at = args.offsets.at[triangle];
  for (uint piece = 0u; piece < pieces; ++piece)
    at = emit_tiles(fixed_piece(polygon, piece, flags, args.target), 8u * triangle + piece, at);
}
