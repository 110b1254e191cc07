#version 460
#include "sph/layout.h"
#include "sph/cells.glsl"

// The cell of a particle, as the key to sort it by; one thread a particle. Source: Green 2010.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { CellKeyArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  SphGrid grid = args.constants.at[0].grid;
  if (args.walls != 0u) grid = args.constants.at[0].wall_grid;
  args.keys.at[i] = cell_index(grid, cell_of(grid, args.positions.at[i].xyz));
  args.ids.at[i] = i;
}
