#version 460
#include "sph/layout.h"
#include "sph/kernel.glsl"
#include "sph/lists.glsl"
#include "sph/forces.glsl"

// Acceleration of a particle by pressure, viscosity, surface tension, walls and gravity; one thread
// a particle. Source: notes 10.4.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { ForceArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  const SphConstants c = args.constants.at[0];
  const vec4 place = args.places.at[i];
  const vec4 motion = args.motions.at[i];
  const uvec2 counts = args.counts.at[i];
  const uint listed = min(counts.y, c.capacity);
  const uint first = list_first(c.capacity, i);
  precise vec3 sum = vec3(0.0);
  for (uint k = 0u; k < counts.x; ++k) {
    const uint j = args.lists.at[first + k * list_stride];
    sum += fluid_acceleration(c, place, motion, args.places.at[j], args.motions.at[j]);
  }
  for (uint k = counts.x; k < listed; ++k) {
    const uint j = args.lists.at[first + k * list_stride];
    sum += wall_acceleration(c, place, motion, args.boundary.at[j], args.boundary_motions.at[j]);
  }
  precise const vec3 acceleration = sum + c.gravity;
  args.accelerations.at[i] = vec4(acceleration, 0.0);
}
