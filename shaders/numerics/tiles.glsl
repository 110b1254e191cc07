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

/// Is a tile visited? False outside the box too.
bool is_listed(TileTable table, uvec3 cells, uvec3 tile) {
  const uvec3 tiles = tiles_of(cells);
  if (any(greaterThanEqual(tile, tiles))) return false;
  return table.visit_all != 0u || (table.flags.at[tile_index(tiles, tile)] & tile_active) != 0u;
}

bool is_active(TileTable table, uvec3 cells, uvec3 tile) {
  const uvec3 tiles = tiles_of(cells);
  if (any(greaterThanEqual(tile, tiles))) return false;
  return (table.flags.at[tile_index(tiles, tile)] & tile_active) != 0u;
}
