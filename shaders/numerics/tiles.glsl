// The tiles that a kernel visits: boxes of 8 x 4 x 4 cells, of flat grids one cell
// thick. Needs numerics/layout.h.

/// 0: the whole box. 1: the tiles of a list.
layout(constant_id = 2) const uint with_tiles = 0u;

const uvec3 tile_side = uvec3(tile_x, tile_yz, tile_yz);

uvec3 tiles_of(uvec3 cells) { return (cells + tile_side - 1u) / tile_side; }

uvec3 tile_at(uint packed_tile) {
  return uvec3(packed_tile & 1023u, (packed_tile >> 10u) & 1023u, packed_tile >> 20u);
}

uint packed(uvec3 tile) { return tile.x | (tile.y << 10u) | (tile.z << 20u); }

uint tile_index(uvec3 tiles, uvec3 tile) { return (tile.z * tiles.y + tile.y) * tiles.x + tile.x; }

/// Is a tile active? False outside the box too.
bool is_active(TileTable table, uvec3 cells, uvec3 tile) {
  const uvec3 tiles = tiles_of(cells);
  if (any(greaterThanEqual(tile, tiles))) return false;
  return (table.flags.at[tile_index(tiles, tile)] & tile_active) != 0u;
}

/// Is a tile what it was in the last step?
bool is_as_before(TileTable table, uvec3 cells, uvec3 tile) {
  const uint flags = table.flags.at[tile_index(tiles_of(cells), tile)];
  return table.visit_all == 0u && (flags == 0u || flags == (tile_active | tile_left));
}

/// Number of a thread among those that cover tiles.
uint thread_of_tiles() {
  return (gl_WorkGroupID.y * group_row + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
}

/// Cells of a tile are 2 to the power of this; flat ones have one along z.
uint tile_bits(uvec3 cells) { return cells.z == 1u ? 5u : 7u; }

/// Cell `slot` of a tile.
uvec3 cell_in_tile(uvec3 tile, uint slot) {
  return tile_side * tile + uvec3(slot & 7u, (slot >> 3u) & 3u, slot >> 5u);
}
