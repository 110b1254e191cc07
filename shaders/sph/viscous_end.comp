#version 460
#include "sph/layout.h"

// The mean acceleration of the step that leads to the velocities found; one thread a particle.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { ViscousEndArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  const float dt = args.clock.at[0].step;
  if (!(dt > 0.0)) return;
  precise const vec3 acceleration = (args.solution.at[i].xyz - args.motions.at[i].xyz) / dt;
  args.accelerations.at[i] = vec4(acceleration, 0.0);
}
