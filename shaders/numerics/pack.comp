#version 460
#include "numerics/layout.h"
#include "numerics/words.glsl"
#include "numerics/tiles.glsl"

// The words of the finest grid from the types of cells and the open parts of faces; one thread a
// cell; of tiles also those that were left. What is no fluid, or no longer, has pressure 0: neighbours
// read it. Source: numerics/layout.h.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { PackArgs args; };

uint steps_of(float open) { return uint(open * 31.0 + 0.5); }

uint face(uvec3 cell, uint axis) {
  const uvec3 size = args.level.cells + uvec3(axis == 0u, axis == 1u, axis == 2u);
  const uint at = (cell.z * size.y + cell.y) * size.x + cell.x;
  return steps_of(axis == 0u ? args.open_x.at[at]
                             : (axis == 1u ? args.open_y.at[at] : args.open_z.at[at]));
}

void main() {
  const uvec3 n = args.level.cells;
  uint slot = gl_GlobalInvocationID.x;
  uvec3 cell;
  if (with_tiles == 0u) {
    if (slot >= slot_count(args.level)) return;
    if (!cell_of_slot(args.level, slot, cell)) {
      ref_uint(args.level.words).at[slot] = 0u;
      return;
    }
  } else {
    const uint bits = tile_bits(n), k = thread_of_tiles() >> bits;
    if (k >= args.tiles.at[0].groups.at[1]) return;
    cell = cell_in_tile(tile_at(args.tiles.at[0].list.at[k]), thread_of_tiles() & ((1u << bits) - 1u));
    if (any(greaterThanEqual(cell, n))) return;
    if (args.keep_tiles != 0u && is_as_before(args.tiles.at[0], n, cell / tile_side)) return;
    slot = slot_of_cell(args.level, cell);
    if (!is_active(args.tiles.at[0], n, cell / tile_side)) {
      ref_uint(args.level.words).at[slot] = pressure_air;
      return;
    }
  }
  const uint type = args.types.at[(cell.z * n.y + cell.y) * n.x + cell.x];
  uint word = type == 0u ? pressure_fluid : (type == 1u ? pressure_air : 0u);
  for (uint axis = 0u; axis < 3u; ++axis) {
    const uvec3 step = uvec3(axis == 0u, axis == 1u, axis == 2u);
    word |= face(cell, axis) << (10u * axis);
    word |= face(cell + step, axis) << (10u * axis + 5u);
  }
  if ((word & 0x3fffffffu) == 0u) word &= ~pressure_fluid;
  ref_uint(args.level.words).at[slot] = word;
  if ((word & pressure_fluid) == 0u) ref_float(args.level.pressure).at[slot] = 0.0;
}
