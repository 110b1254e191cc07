#version 460
#include "numerics/layout.h"
#include "numerics/words.glsl"
#include "numerics/tiles.glsl"

// The words of a grid from those of the one half as wide; one thread a coarse cell. Air if any child
// is, else fluid if any child is; a face is as open as its children on average. Source: McAdams,
// Sifakis & Teran 2010.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { TransferArgs args; };

const uint keep_tiles = 1u;  ///< tiles of the finest grid that are active as before keep their words

void main() {
  const uint slot = gl_GlobalInvocationID.x;
  if (slot >= slot_count(args.coarse)) return;
  uvec3 cell;
  uint word = 0u;
  const uvec3 n = args.fine.cells;
  const uvec3 per = uvec3(n.x > args.coarse.cells.x ? 2u : 1u, n.y > args.coarse.cells.y ? 2u : 1u,
                          n.z > args.coarse.cells.z ? 2u : 1u);
  if (cell_of_slot(args.coarse, slot, cell)) {
    if (args.mode == keep_tiles && is_as_before(args.tiles.at[0], n, cell * per / tile_side)) return;
    const uvec3 low = cell * per, high = min(low + per, n) - 1u;
    uint open[6] = uint[6](0u, 0u, 0u, 0u, 0u, 0u);
    uint kinds = 0u;
    for (uint k = 0u; k < 8u; ++k) {
      const uvec3 child = low + uvec3(k & 1u, (k >> 1u) & 1u, k >> 2u);
      if (any(greaterThan(child, high))) continue;
      const uint w = ref_uint(args.fine.words).at[slot_of_cell(args.fine, child)];
      kinds |= w;
      for (uint axis = 0u; axis < 3u; ++axis) {
        if (child[axis] == low[axis]) open[2u * axis] += (w >> (10u * axis)) & 31u;
        if (child[axis] == high[axis]) open[2u * axis + 1u] += (w >> (10u * axis + 5u)) & 31u;
      }
    }
    word = (kinds & pressure_air) != 0u ? pressure_air : kinds & pressure_fluid;
    for (uint axis = 0u; axis < 3u; ++axis) {
      const uint faces = per[(axis + 1u) % 3u] * per[(axis + 2u) % 3u];
      word |= ((open[2u * axis] + faces / 2u) / faces) << (10u * axis);
      word |= ((open[2u * axis + 1u] + faces / 2u) / faces) << (10u * axis + 5u);
    }
  }
  ref_uint(args.coarse.words).at[slot] = word;
}
