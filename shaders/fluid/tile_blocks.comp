#version 460
#include "numerics/layout.h"
#include "fluid/layout.h"
#include "fluid/grid.glsl"
#include "numerics/tiles.glsl"

// Is there anything in a block of 4 cells a side? Eight threads a listed tile, one a block. What was
// not listed is empty. Source: sim/fluid.h, active_cells.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { FluidTileArgs args; };

bool moves(FluidScene scene, uint axis, ivec3 face) {
  return abs(read_face(args.velocity, axis, point_index(points_of(scene.cells, axis), face))) >
         scene.busy_speed;
}

bool is_busy(FluidScene scene, ivec3 cell) {
  const uint index = point_index(ivec3(scene.cells), cell);
  if (args.is_liquid != 0u) return args.ranges.at[2u * index + 1u] > 0u;
  if (args.smoke.at[index] > scene.busy_smoke || abs(args.temperature.at[index]) > scene.busy_heat)
    return true;
  for (uint axis = 0u; axis < 3u; ++axis)
    if (moves(scene, axis, cell) || moves(scene, axis, cell + unit(axis))) return true;
  return false;
}

void main() {
  if (args.clock.at[0].step == 0.0) return;
  FluidScene scene = args.scene.at[0];
  TileTable table = scene.tiles.at[0];
  const uint k = gl_GlobalInvocationID.x / 8u, block = gl_GlobalInvocationID.x % 8u;
  if (k >= table.groups.at[0]) return;
  const uvec3 tile = tile_at(table.list.at[k]);
  const uvec3 low = grid_tile * tile + block_side * uvec3(block & 1u, (block >> 1u) & 1u, block >> 2u);
  const uvec3 high = min(low + block_side, scene.cells);
  const uint place = 8u * tile_index(tiles_of(scene.cells), tile) + block;
  bool busy = args.held.at[place] != 0u;
  for (uint z = low.z; z < high.z; ++z)
    for (uint y = low.y; y < high.y; ++y)
      for (uint x = low.x; x < high.x; ++x) busy = busy || is_busy(scene, ivec3(x, y, z));
  args.blocks.at[place] = busy ? 1u : 0u;
}
