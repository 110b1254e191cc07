#version 460
#include "sph/layout.h"

// Moves particles by the velocities that the pressure solver has found, back to the order of the
// ids; one thread a particle. Source: Bender & Koschier 2015.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { SolveEndArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  const float dt = args.clock.at[0].step;
  if (!(dt > 0.0)) return;
  const uint id = args.ids.at[i];
  const vec4 place = args.places.at[i];
  const vec3 velocity = args.moved.at[i].xyz;
  precise const vec3 position = place.xyz + dt * velocity;
  precise const float pressure = args.impulses.at[i] * place.w * place.w / dt;
  args.velocities.at[id] = vec4(velocity, 0.0);
  args.positions.at[id] = vec4(position, 0.0);
  args.densities.at[id] = place.w;
  args.pressures.at[id] = pressure;
}
