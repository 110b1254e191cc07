#version 460
#include "sph/layout.h"
#include "sph/cells.glsl"
#include "sph/kernel.glsl"

// How much fluid a wall particle stands for: the more crowded, the less; one thread a wall
// particle. Source: Akinci et al. 2012, with a share that fits them to the lattice at rest.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { BoundaryVolumeArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  const SphConstants c = args.constants.at[0];
  const vec3 p = args.boundary.at[i].xyz;
  const ivec3 cell = cell_of(c.grid, p);
  const int reach_z = int(c.grid.reach_z);
  precise float sum = 0.0;
  for (int dz = -reach_z; dz <= reach_z; ++dz) {
    for (int dy = -row_reach; dy <= row_reach; ++dy) {
      const uvec2 range = row_range(c.grid, args.starts, p, cell, dy, dz);
      for (uint j = range.x; j < range.y; ++j) {
        precise const vec3 d = p - args.boundary.at[j].xyz;
        sum += kernel_value(squared_length(d), c.inverse_support, c.kernel_scale);
      }
    }
  }
  args.weighted.at[i] = vec4(p, c.rest_density * c.wall_share / sum);
}
