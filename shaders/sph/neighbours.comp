#version 460
#include "sph/layout.h"
#include "sph/cells.glsl"
#include "sph/kernel.glsl"
#include "sph/lists.glsl"

// Lists the particles and the wall particles closer than the support, in sorted order, and sums the
// density over them, as long as they are at hand; one thread a particle. Counts go on beyond the
// lists' capacity. Sources: Green 2010; notes 10.4; Akinci et al. 2012.
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
  const int reach_z = int(grid.reach_z);
  const float inverse_support = args.constants.at[0].inverse_support;
  const float scale = args.constants.at[0].kernel_scale;
  uint found = 0u;
  precise float sum = 0.0;
  precise float walls = 0.0;
  for (int dz = -reach_z; dz <= reach_z; ++dz) {
    for (int dy = -row_reach; dy <= row_reach; ++dy) {
      const uvec2 range = row_range(grid, args.starts, p, cell, dy, dz);
      for (uint j = range.x; j < range.y; ++j) {
        precise const vec3 d = p - args.positions.at[j].xyz;
        const float r2 = squared_length(d);
        sum += kernel_value(r2, inverse_support, scale);
        if (r2 < reach && j != i) {
          if (found < capacity) args.lists.at[first + found * list_stride] = j;
          ++found;
        }
      }
    }
  }
  const uint fluid = min(found, capacity);
  const uint at = cell_index(grid, cell);
  if ((args.near_walls.at[at / 32u] >> (at % 32u) & 1u) != 0u) {
    for (int dz = -reach_z; dz <= reach_z; ++dz) {
      for (int dy = -row_reach; dy <= row_reach; ++dy) {
        const uvec2 range = row_range(grid, args.boundary_starts, p, cell, dy, dz);
        for (uint j = range.x; j < range.y; ++j) {
          const vec4 wall = args.boundary.at[j];
          precise const vec3 d = p - wall.xyz;
          const float r2 = squared_length(d);
          walls += wall.w * kernel_value(r2, inverse_support, scale);
          if (r2 < reach) {
            if (found < capacity) args.lists.at[first + found * list_stride] = j;
            ++found;
          }
        }
      }
    }
  }
  args.counts.at[i] = uvec2(fluid, found);
  precise const float density = args.constants.at[0].mass * sum + walls;
  args.densities.at[i] = density;
}
