// Tiles of the compute rasteriser: which of them a triangle touches, and the tests of their samples.
// Source: Pineda 1988; Laine & Karras 2011.
#ifndef PARITY_RASTER_TILE_GLSL
#define PARITY_RASTER_TILE_GLSL

#include "raster/layout.h"

/// Places of the standard samples in 1/16 pixel from the centre of the pixel. Source: Vulkan 1.3,
/// "Multisampling".
const ivec2 sample_places_2[2] = {ivec2(4, 4), ivec2(-4, -4)};
const ivec2 sample_places_4[4] = {ivec2(-2, -6), ivec2(6, -2), ivec2(-6, 2), ivec2(2, 6)};
const ivec2 sample_places_8[8] = {ivec2(1, -3), ivec2(-1, 3), ivec2(5, 1),  ivec2(-3, -5),
                                  ivec2(-5, 5), ivec2(-7, -1), ivec2(3, 7), ivec2(7, -7)};

ivec2 sample_place(uint samples, uint s) {
  return samples == 8u   ? sample_places_8[s]
         : samples == 4u ? sample_places_4[s]
         : samples == 2u ? sample_places_2[s]
                         : ivec2(0);
}

/// Fixed point of the middle of a tile.
ivec2 tile_middle(uint tile, uint tiles_x) {
  return ivec2(tile % tiles_x, tile / tiles_x) * int(tile_side) * subpixel_units +
         (int(tile_side) - 1) * subpixel_units / 2;
}

/// Step (i, j) of a sample, in 1/16 pixel from the middle of its tile.
ivec2 tile_step(uvec2 pixel_in_tile, ivec2 place) {
  return ivec2(pixel_in_tile) * 16 - (int(tile_side) - 1) * 8 + place;
}

ivec3 tile_edges(TileTriangle t, ivec2 at) { return t.edge + t.edge_x * at.x + t.edge_y * at.y; }

bool tile_covers(TileTriangle t, ivec2 at) {
  const ivec3 e = tile_edges(t, at);
  return (e.x | e.y | e.z) >= 0;
}

/// Inside all edges and not unseen.
bool is_shown(ivec3 edges, uint element) {
  return (edges.x | edges.y | edges.z | int(element)) >= 0;
}

float tile_depth(TileTriangle t, ivec2 at) {
  precise float z = t.depth.x + (t.depth.y * float(at.x) + t.depth.z * float(at.y));
  return z;
}

#endif
