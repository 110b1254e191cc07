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
  const ivec3 cell = cell_of(c.wall_grid, p);
  const vec3 at = place_in_cells(c.wall_grid, p);
  precise float sum = 0.0;
  for (int dz = -c.wall_grid.reach_z; dz <= c.wall_grid.reach_z; ++dz) {
    const float left = whole_support - row_distance(at.z, cell.z, dz, c.wall_grid.cells.z, c.wall_grid.reach);
    const int layer = (cell.z + dz) * int(c.wall_grid.cells.y) + cell.y;
    for (int dy = -c.wall_grid.reach; dy <= c.wall_grid.reach; ++dy) {
      const float rest = left - row_distance(at.y, cell.y, dy, c.wall_grid.cells.y, c.wall_grid.reach);
      if (rest > 0.0) {
        const uvec2 range = row_range(c.wall_grid, args.starts, at.x, layer + dy, rest);
        for (uint j = range.x; j < range.y; ++j) {
          precise const vec3 d = p - args.boundary.at[j].xyz;
          sum += kernel_value(squared_length(d), c.inverse_support, c.kernel_scale);
        }
      }
    }
  }
  args.weighted.at[i] = vec4(p, c.rest_density * c.wall_share / sum);
}
