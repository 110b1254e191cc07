#version 460
#include "sph/layout.h"
#include "sph/state.glsl"

// Place and density of a particle, velocity and pressure, side by side for the passes that follow;
// one thread a particle. Source: notes 10.4.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { DensityArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  const float density = args.densities.at[i];
  args.places.at[i] = vec4(args.positions.at[i].xyz, density);
  args.motions.at[i] = vec4(args.velocities.at[args.ids.at[i]].xyz,
                            pressure_over_density_squared(args.constants.at[0], density));
}
