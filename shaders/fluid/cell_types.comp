#version 460
#include "numerics/layout.h"
#include "fluid/layout.h"
#include "fluid/grid.glsl"
#include "numerics/tiles.glsl"
#include "fluid/points.glsl"

// Solid, fluid or air; one thread a cell. What lies in no active tile counts as air. Source: sim/fluid.h, cell_types.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { FluidCellArgs args; };

void main() {
  FluidScene scene = args.scene.at[0];
  const uvec3 cells = scene.cells;
  ivec3 cell;
  if (!touched_cell_of_thread(scene, cell)) return;
  // Solids of sparse smoke are at rest: only tiles that come or go change.
  if (with_tiles != 0u && args.is_liquid == 0u &&
      is_as_before(scene.tiles.at[0], cells, uvec3(cell) / tile_side))
    return;
  const uint index = point_index(ivec3(cells), cell);
  float room = 0.0;
  for (uint axis = 0u; axis < 3u; ++axis) {
    const ivec3 size = points_of(cells, axis);
    room += read_face(args.open, axis, point_index(size, cell)) +
            read_face(args.open, axis, point_index(size, cell + unit(axis)));
  }
  uint type = 0u;
  if (args.is_liquid != 0u && args.ranges.at[2u * index + 1u] == 0u) type = 1u;
  if (room == 0.0) type = 2u;
  if (with_tiles != 0u && !in_active_tile(scene, cell)) type = 1u;
  args.types.at[index] = type;
}
