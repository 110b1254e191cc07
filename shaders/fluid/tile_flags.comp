#version 460
#include "numerics/layout.h"
#include "fluid/layout.h"
#include "fluid/grid.glsl"
#include "numerics/tiles.glsl"

// A tile is active where a cell in it, or within a margin of it in the tiles around, is busy; one
// thread a tile of the box. Source: sim/fluid.h, active_cells.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { FluidTileArgs args; };

/// Bits of the first `count` of `size` places (towards > 0), the last (towards < 0), or all.
uint near_side(int towards, uint size, uint count) {
  const uint all = (1u << size) - 1u;
  return towards == 0 ? all : (towards > 0 ? (1u << min(count, size)) - 1u : all & ~(all >> min(count, size)));
}

/// Is a cell of the tile `step` away busy that lies within the margin?
bool is_near(uvec3 tiles, ivec3 tile, ivec3 step, uint margin) {
  const ivec3 there = tile + step;
  if (any(lessThan(there, ivec3(0))) || any(greaterThanEqual(there, ivec3(tiles)))) return false;
  const uint rows = near_side(step.y, tile_yz, margin), planes = near_side(step.z, tile_yz, margin);
  const uint row = near_side(step.x, tile_x, margin);
  uint mask = 0u;
  for (uint y = 0u; y < tile_yz; ++y)
    if (((rows >> y) & 1u) != 0u) mask |= row << (tile_x * y);
  const uint place = 4u * tile_index(tiles, uvec3(there));
  for (uint z = 0u; z < tile_yz; ++z)
    if (((planes >> z) & 1u) != 0u && (args.busy.at[place + z] & mask) != 0u) return true;
  return false;
}

void main() {
  if (args.clock.at[0].step == 0.0) return;
  FluidScene scene = args.scene.at[0];
  TileTable table = scene.tiles.at[0];
  const uvec3 tiles = tiles_of(scene.cells);
  const uint t = gl_GlobalInvocationID.x;
  if (t >= tiles.x * tiles.y * tiles.z) return;
  const ivec3 tile = ivec3(t % tiles.x, t / tiles.x % tiles.y, t / (tiles.x * tiles.y));
  bool busy = false;
  for (int k = 0; k < 27 && !busy; ++k)
    busy = is_near(tiles, tile, ivec3(k % 3, k / 3 % 3, k / 9) - 1, scene.margin);
  const bool was = (table.flags.at[t] & tile_active) != 0u;
  table.flags.at[t] = (busy ? tile_active : 0u) | (was ? tile_left : 0u);
}
