#version 460
#include "sph/layout.h"
#include "sph/cells.glsl"
#include "sph/kernel.glsl"
#include "sph/lists.glsl"

// Lists the particles and the wall particles closer than the support, in sorted order, and sums the
// density over them, as long as they are at hand; one thread a particle. Counts go on beyond the
// lists' capacity. Every candidate is written to the next free place of the list, and only a neighbour
// takes it: a store that all threads make costs less than one that each decides on. Sources: Green 2010; notes 10.4; Akinci et al. 2012.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { NeighbourArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  const SphGrid grid = args.constants.at[0].grid;
  const float support = args.constants.at[0].support;
  const uint capacity = args.constants.at[0].capacity;
  const uint first = list_first(capacity, i);
  precise const float reach = support * support;
  const vec3 p = args.positions.at[i].xyz;
  const ivec3 cell = cell_of(grid, p);
  const vec3 at = place_in_cells(grid, p);
  const float inverse_support = args.constants.at[0].inverse_support;
  const float scale = args.constants.at[0].kernel_scale;
  uint found = 0u;
  precise float sum = 0.0;
  for (int dz = -grid.reach_z; dz <= grid.reach_z; ++dz) {
    const float left = whole_support - row_distance(at.z, cell.z, dz, grid.cells.z, grid.reach);
    const int layer = (cell.z + dz) * int(grid.cells.y) + cell.y;
    for (int dy = -grid.reach; dy <= grid.reach; ++dy) {
      const float rest = left - row_distance(at.y, cell.y, dy, grid.cells.y, grid.reach);
      if (rest > 0.0) {
        const uvec2 range = row_range(grid, args.starts, at.x, layer + dy, rest);
        for (uint j = range.x; j < range.y; ++j) {
          precise const vec3 d = p - args.positions.at[j].xyz;
          const float r2 = squared_length(d);
          sum += kernel_value(r2, inverse_support, scale);
          args.lists.at[first + min(found, capacity) * list_stride] = j;
          found += r2 < reach && j != i ? 1u : 0u;
        }
      }
    }
  }
  const uint fluid = min(found, capacity);
  precise float walls = 0.0;
  const uint own = cell_index(grid, cell);
  if ((args.near_walls.at[own / 32u] >> (own % 32u) & 1u) != 0u) {
    const SphGrid wall_grid = args.constants.at[0].wall_grid;
    const ivec3 wall_cell = cell_of(wall_grid, p);
    const vec3 wall_at = place_in_cells(wall_grid, p);
    for (int dz = -wall_grid.reach_z; dz <= wall_grid.reach_z; ++dz) {
      const float left = whole_support - row_distance(wall_at.z, wall_cell.z, dz, wall_grid.cells.z, wall_grid.reach);
      const int layer = (wall_cell.z + dz) * int(wall_grid.cells.y) + wall_cell.y;
      for (int dy = -wall_grid.reach; dy <= wall_grid.reach; ++dy) {
        const float rest = left - row_distance(wall_at.y, wall_cell.y, dy, wall_grid.cells.y, wall_grid.reach);
        if (rest > 0.0) {
          const uvec2 range = row_range(wall_grid, args.boundary_starts, wall_at.x, layer + dy, rest);
          for (uint j = range.x; j < range.y; ++j) {
            const vec4 wall = args.boundary.at[j];
            precise const vec3 d = p - wall.xyz;
            const float r2 = squared_length(d);
            walls += wall.w * kernel_value(r2, inverse_support, scale);
            args.lists.at[first + min(found, capacity) * list_stride] = j;
            found += r2 < reach ? 1u : 0u;
          }
        }
      }
    }
  }
  args.counts.at[i] = uvec2(fluid, found);
  precise const float density = args.constants.at[0].mass * sum + walls;
  args.densities.at[i] = density;
}
