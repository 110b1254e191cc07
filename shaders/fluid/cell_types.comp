#version 460
#include "numerics/layout.h"
#include "fluid/layout.h"
#include "fluid/grid.glsl"

// Solid, fluid or air; one thread a cell. Source: sim/fluid.h, cell_types.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { FluidCellArgs args; };

void main() {
  const uvec3 cells = args.scene.at[0].cells;
  const uint index = gl_GlobalInvocationID.x;
  if (index >= cells.x * cells.y * cells.z) return;
  const ivec3 cell = point_of(ivec3(cells), index);
  float room = 0.0;
  for (uint axis = 0u; axis < 3u; ++axis) {
    const ivec3 size = points_of(cells, axis);
    room += read_face(args.open, axis, point_index(size, cell)) +
            read_face(args.open, axis, point_index(size, cell + unit(axis)));
  }
  uint type = 0u;
  if (args.is_liquid != 0u && args.ranges.at[2u * index + 1u] == 0u) type = 1u;
  args.types.at[index] = room == 0.0 ? 2u : type;
}
