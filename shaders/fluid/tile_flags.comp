#version 460
#include "numerics/layout.h"
#include "fluid/layout.h"
#include "fluid/grid.glsl"
#include "numerics/tiles.glsl"

// A tile is active where one of its blocks or of those around it is busy; one thread a tile of the
// box. Source: sim/fluid.h, active_cells.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { FluidTileArgs args; };

bool is_busy_block(uvec3 tiles, ivec3 block) {
  const ivec3 tile = block >> 1, odd = block & 1;
  if (any(lessThan(block, ivec3(0))) || any(greaterThanEqual(tile, ivec3(tiles)))) return false;
  return args.blocks.at[8u * tile_index(tiles, uvec3(tile)) + uint(odd.x + 2 * odd.y + 4 * odd.z)] != 0u;
}

void main() {
  if (args.clock.at[0].step == 0.0) return;
  FluidScene scene = args.scene.at[0];
  TileTable table = scene.tiles.at[0];
  const uvec3 tiles = tiles_of(scene.cells);
  const uint t = gl_GlobalInvocationID.x;
  if (t >= tiles.x * tiles.y * tiles.z) return;
  const ivec3 first = 2 * ivec3(t % tiles.x, t / tiles.x % tiles.y, t / (tiles.x * tiles.y)) - 1;
  bool busy = false;
  for (uint k = 0u; k < 64u && !busy; ++k)
    busy = is_busy_block(tiles, first + ivec3(k & 3u, (k >> 2u) & 3u, k >> 4u));
  const bool was = (table.flags.at[t] & tile_active) != 0u;
  table.flags.at[t] = (busy ? tile_active : 0u) | (was ? tile_left : 0u);
}
