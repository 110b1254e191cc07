#version 460
#include "sph/layout.h"
#include "sph/rounds.glsl"

// From the velocities that compress nothing to those without pressure at the end of the step, and
// the pressures to begin with; one thread a particle, the first also starts the solver. Source:
// Bender & Koschier 2017.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { SolvePredictArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  const float dt = args.clock.at[0].step;
  if (i == 0u) {
    args.solver.at[0] = SphSolver(dt > 0.0 ? 1u : 0u, 0u, 0.0, 0.0);
    set_rounds(args.groups, dt > 0.0, args.count, args.block);
  }
  const float density = args.places.at[i].w;
  precise const vec3 velocity = args.moved.at[i].xyz + dt * args.accelerations.at[i].xyz;
  precise const float impulse = dt * args.pressures.at[args.ids.at[i]] / (density * density);
  args.predicted.at[i].xyz = velocity;
  args.impulses.at[i] = impulse;
}
