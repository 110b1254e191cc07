#version 460
#include "numerics/layout.h"
#include "fluid/layout.h"
#include "fluid/grid.glsl"

// The cell of each particle, to sort by; one thread a particle. Source: sim/fluid.h, particle_cell.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { LiquidArgs args; };

void main() {
  const uint id = gl_GlobalInvocationID.x;
  if (id >= args.count) return;
  FluidScene scene = args.scene.at[0];
  precise float cells_per_metre = 1.0 / scene.spacing;
  precise vec3 place = (args.positions.at[id] - scene.origin) * cells_per_metre;
  const ivec3 cell = clamp(ivec3(floor(place)), ivec3(0), ivec3(scene.cells) - 1);
  args.keys.at[id] = point_index(ivec3(scene.cells), cell);
  args.sorted.at[id] = id;
}
