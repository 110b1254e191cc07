#version 460
#include "numerics/layout.h"
#include "fluid/layout.h"
#include "fluid/grid.glsl"
#include "numerics/tiles.glsl"
#include "fluid/points.glsl"

// The largest speed along each axis: one thread finds it for `weight` faces of an axis. Source: notes
// 10.4, the CFL condition.
// Specialized with of_difference: the largest difference to `other` instead, of the whole box.
layout(local_size_x = 64) in;
layout(constant_id = 3) const uint of_difference = 0u;
layout(scalar, push_constant) uniform Push { FluidArgs args; };

void main() {
  float largest = 0.0;
  if (with_tiles != 0u) {
    FluidScene scene = args.scene.at[0];
    const uint id = gl_GlobalInvocationID.x;
    const uint part = (slots_of_list(scene, args.axis) + tile_speeds - 1u) / tile_speeds;
    for (uint slot = id * part; slot < (id + 1u) * part; ++slot) {
      ivec3 at;
      if (!point_of_slot(scene, args.axis, slot, at)) continue;
      const uint index = point_index(points_of(scene.cells, args.axis), at);
      largest = max(largest, abs(read_face(args.velocity, args.axis, index)));
    }
    if (id < tile_speeds) args.field.at[args.mode + id] = largest;
    return;
  }
  const uint run = uint(args.weight);
  const uvec3 cells = args.scene.at[0].cells;
  const uint begin = gl_GlobalInvocationID.x * run;
  const uint end = min(begin + run, point_count(points_of(cells, args.axis)));
  for (uint k = begin; k < end; ++k) {
    float value = read_face(args.velocity, args.axis, k);
    if (of_difference != 0u) value -= read_face(args.other, args.axis, k);
    largest = max(largest, abs(value));
  }
  if (begin < end) args.field.at[args.mode + gl_GlobalInvocationID.x] = largest;
}
