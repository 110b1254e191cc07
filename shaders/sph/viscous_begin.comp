#version 460
#include "sph/layout.h"
#include "sph/rounds.glsl"

// Starts conjugate gradients from the velocities without implicit viscosity; one thread a particle,
// the first also starts the solver. Source: Weiler et al. 2018.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { ViscousBeginArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  const float dt = args.clock.at[0].step;
  if (i == 0u) {
    args.solver.at[0] = SphViscous(dt > 0.0 ? 1u : 0u, 0u, 0.0, 0.0, 0.0, 0.0);
    set_rounds(args.groups, dt > 0.0, args.count, args.block);
  }
  precise const vec3 velocity = args.motions.at[i].xyz + dt * args.accelerations.at[i].xyz;
  args.solution.at[i] = vec4(velocity, 0.0);
  args.direction.at[i] = vec4(0.0);
  args.image.at[i] = vec4(0.0);
}
