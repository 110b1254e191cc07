#version 460
#include "numerics/layout.h"
#include "fluid/layout.h"
#include "fluid/grid.glsl"

// The largest speed along each axis: one thread finds it for `weight` faces of an axis. Source: notes
// 10.4, the CFL condition.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { FluidArgs args; };

void main() {
  const uint run = uint(args.weight);
  const uvec3 cells = args.scene.at[0].cells;
  float largest = 0.0;
  const uint begin = gl_GlobalInvocationID.x * run;
  const uint end = min(begin + run, point_count(points_of(cells, args.axis)));
  for (uint k = begin; k < end; ++k)
    largest = max(largest, abs(read_face(args.velocity, args.axis, k)));
  if (begin < end) args.field.at[args.mode + gl_GlobalInvocationID.x] = largest;
}
