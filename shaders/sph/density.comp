#version 460
#include "sph/layout.h"
#include "sph/kernel.glsl"
#include "sph/state.glsl"

// Density of a particle from its neighbours and the walls, and from it the pressure; one thread a
// particle. Sources: notes 10.4; Akinci et al. 2012.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { DensityArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  const SphConstants c = args.constants.at[0];
  const vec3 p = args.positions.at[i].xyz;
  const uvec2 counts = args.counts.at[i];
  const uint listed = min(counts.y, c.capacity);
  precise float sum = kernel_value(0.0, c.support, c.kernel_scale);
  for (uint k = 0u; k < counts.x; ++k) {
    precise const vec3 d = p - args.positions.at[args.lists.at[k * args.count + i]].xyz;
    sum += kernel_value(squared_length(d), c.support, c.kernel_scale);
  }
  precise float walls = 0.0;
  for (uint k = counts.x; k < listed; ++k) {
    const vec4 wall = args.boundary.at[args.lists.at[k * args.count + i]];
    precise const vec3 d = p - wall.xyz;
    walls += wall.w * kernel_value(squared_length(d), c.support, c.kernel_scale);
  }
  precise const float density = c.mass * sum + walls;
  args.places.at[i] = vec4(p, density);
  args.motions.at[i] = vec4(args.velocities.at[args.ids.at[i]].xyz,
                            pressure_over_density_squared(c, density));
}
