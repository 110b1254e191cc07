#version 460
#include "sph/layout.h"

// Kick, then drift: symplectic Euler; back to the order of the ids. One thread a particle. Source:
// notes 10.1.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { IntegrateArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  const float dt = args.clock.at[0].step;
  const uint id = args.ids.at[i];
  precise const vec3 velocity = args.motions.at[i].xyz + dt * args.accelerations.at[i].xyz;
  precise const vec3 position = args.places.at[i].xyz + dt * velocity;
  args.velocities.at[id] = vec4(velocity, 0.0);
  args.positions.at[id] = vec4(position, 0.0);
  const float density = args.places.at[i].w;
  args.densities.at[id] = density;
  args.pressures.at[id] = args.motions.at[i].w * density * density;
}
