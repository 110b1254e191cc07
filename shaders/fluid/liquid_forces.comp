#version 460
#include "numerics/layout.h"
#include "fluid/layout.h"
#include "fluid/grid.glsl"

// Gravity; one thread a face. Source: notes 10.4.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { LiquidArgs args; };

void main() {
  const float step = args.clock.at[0].step;
  if (step == 0.0) return;
  const uvec3 cells = args.scene.at[0].cells;
  const uint index = gl_GlobalInvocationID.x;
  if (index >= point_count(points_of(cells, args.axis))) return;
  write_face(args.velocity, args.axis, index,
             read_face(args.velocity, args.axis, index) + step * args.scene.at[0].force[args.axis]);
}
