#version 460
#include "numerics/layout.h"
#include "fluid/layout.h"
#include "fluid/grid.glsl"
#include "numerics/tiles.glsl"
#include "fluid/points.glsl"
#include "numerics/words.glsl"

// The points of tiles that were left are at rest and empty; one thread a point. Source: sim/fluid.h,
// active_cells.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { FluidArgs args; };

const uint quads = 0u;  ///< of cells as the pressure is stored; else numbers a cell

void main() {
  if (args.clock.at[0].step == 0.0) return;
  FluidScene scene = args.scene.at[0];
  // The tiles that were left stand in the list behind the others.
  TileTable table = scene.tiles.at[0];
  const uint volume = 1u << tile_bits(scene.cells);
  const uint slots = volume + (args.axis < 3u ? tile_top : 0u);
  const uint k = table.groups.at[0] + thread_of_tiles() / slots, slot = thread_of_tiles() % slots;
  if (k >= table.groups.at[1]) return;
  const uvec3 tile = tile_at(table.list.at[k]);
  ivec3 at;
  if (slot < volume ? !point_in_tile(scene.cells, tile, slot, at)
                    : !point_on_top(scene.cells, args.axis, tile, slot - volume, at))
    return;
  if (is_active_point(scene, args.axis, at)) return;
  const uint index = point_index(points_of(scene.cells, args.axis), at);
  if (args.axis < 3u) {
    write_face(args.velocity, args.axis, index, 0.0);
    write_face(args.other, args.axis, index, 0.0);
    write_face(args.result, args.axis, index, 0.0);
  } else if (args.mode == quads) {
    PressureLevel level;
    level.cells = scene.cells;
    level.row = (scene.cells.x + 7u) / 8u;
    args.field.at[slot_of_cell(level, uvec3(at))] = 0.0;
  } else {
    for (uint k = 0u; k < args.mode; ++k) args.field.at[args.mode * index + k] = 0.0;
  }
}
