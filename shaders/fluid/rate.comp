#version 460
#include "numerics/layout.h"
#include "fluid/layout.h"
#include "fluid/grid.glsl"
#include "fluid/momentum.glsl"

// One stage of the Runge-Kutta method of order 3 that keeps what Euler's method keeps: result =
// weight * other + (1 - weight) * (velocity + step * rate); one thread a face. Source: Shu & Osher
// 1988; notes 10.4.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { FluidArgs args; };

void main() {
  const FluidClock clock = args.clock.at[0];
  if (clock.step == 0.0) return;
  FluidScene scene = args.scene.at[0];
  const ivec3 size = points_of(scene.cells, args.axis);
  const uint index = gl_GlobalInvocationID.x;
  if (index >= point_count(size)) return;
  const ivec3 at = point_of(size, index);
  if (in_closed_wall(scene, args.axis, at)) {
    write_face(args.result, args.axis, index, 0.0);
    return;
  }
  const float here = read_face(args.velocity, args.axis, index);
  precise float rate = advection_rate(scene, args.velocity, args.axis, at) + scene.force[args.axis];
  if (scene.viscosity > 0.0)
    rate += scene.viscosity / (scene.spacing * scene.spacing) *
            second_differences(scene, args.velocity, args.axis, at);
  precise float moved = here + clock.step * rate;
  precise float mixed =
      args.weight * read_face(args.other, args.axis, index) + (1.0 - args.weight) * moved;
  write_face(args.result, args.axis, index, args.weight == 0.0 ? moved : mixed);
}
