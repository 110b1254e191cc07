#version 460
#include "numerics/layout.h"
#include "numerics/pressure.glsl"
#include "numerics/transfer.glsl"
#include "numerics/tiles.glsl"

// Restriction and prolongation of a multigrid cycle. Restricting, one thread takes four coarse cells
// along x; prolonging, one quad. Source: Trottenberg, Oosterlee & Schueller 2001; the interpolation
// is that of Khalil & Wesseling 1992.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { TransferArgs args; };

layout(constant_id = 1) const uint mode = 0u;
const uint restrict_residual = 0u;
const uint restrict_rhs = 1u;
const uint prolong_red = 2u;   ///< adds to the red cells
const uint prolong_both = 3u;  ///< replaces all cells

void main() {
  if (args.control.at[0].done != 0u) return;
  const bool down = mode <= restrict_rhs;
  // A row of coarse cells in fours is as long as a row of fine quads.
  const uint row = down ? (args.coarse.cells.x + 3u) / 4u : args.fine.row;
  const uvec2 size = down ? args.coarse.cells.yz : args.fine.cells.yz;
  const uint id = gl_GlobalInvocationID.x;
  uint i = id % row, y = (id / row) % size.x, z = id / (row * size.x);
  if (with_tiles == 0u && id >= row * size.x * size.y) return;
  if (with_tiles != 0u) {
    // Under a fine tile lie two by two rows of coarse cells, in it four by four of quads.
    const uint side = down ? 2u : 4u, k = id / (side * side);
    TileTable table = args.tiles.at[0];
    if (k >= table.groups.at[0]) return;
    const uvec3 tile = tile_at(table.list.at[k]);
    i = tile.x;
    y = side * tile.y + id % side;
    z = side * tile.z + id / side % side;
    if (y >= size.x || z >= size.y) return;
  }
  if (mode == restrict_residual) {
    store_row(args.coarse, i, y, z, restricted_residual(args.fine, args.coarse, i, y, z));
  } else if (mode == restrict_rhs) {
    store_row(args.coarse, i, y, z, restricted_rhs(args.fine, args.coarse, i, y, z));
  } else {
    prolong_quad(args.fine, args.coarse, 0u, i, y, z, mode == prolong_red);
    if (mode == prolong_both) prolong_quad(args.fine, args.coarse, 1u, i, y, z, false);
  }
}
