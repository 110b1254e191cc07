#version 460
#include "numerics/layout.h"
#include "fluid/layout.h"
#include "fluid/grid.glsl"
#include "numerics/tiles.glsl"

// Which cells hold anything: four threads a listed tile, a plane of it each. What was not listed is
// empty. Source: sim/fluid.h, active_cells.
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
  const uint k = gl_GlobalInvocationID.x / 4u, plane = gl_GlobalInvocationID.x % 4u;
  if (k >= table.groups.at[0]) return;
  const uvec3 tile = tile_at(table.list.at[k]);
  const uint place = 4u * tile_index(tiles_of(scene.cells), tile) + plane;
  uint bits = args.held.at[place];
  for (uint bit = 0u; bit < 32u; ++bit) {
    const uvec3 cell = tile_side * tile + uvec3(bit % tile_x, bit / tile_x, plane);
    if (all(lessThan(cell, scene.cells)) && is_busy(scene, ivec3(cell))) bits |= 1u << bit;
  }
  args.busy.at[place] = bits;
}
