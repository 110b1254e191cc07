#version 460
#include "sph/layout.h"
#include "sph/kernel.glsl"
#include "sph/lists.glsl"
#include "sph/viscosity.glsl"

// The matrix of the implicit viscosity times a velocity, matrix-free; or, first, the residual of the
// velocities to begin with. One thread a particle. Source: Weiler et al. 2018.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { ViscousApplyArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count || args.solver.at[0].running == 0u) return;
  const SphConstants c = args.constants.at[0];
  const float dt = args.clock.at[0].step;
  const vec4 place = args.places.at[i];
  const vec3 x = args.from.at[i].xyz;
  const uvec2 counts = args.counts.at[i];
  const uint listed = min(counts.y, c.capacity);
  const uint first = list_first(c.capacity, i);
  precise vec3 sum = vec3(0.0);
  for (uint k = 0u; k < counts.x; ++k) {
    const uint j = args.lists.at[first + k * list_stride];
    const vec4 other = args.places.at[j];
    precise const float weight = 2.0 * c.mass / (place.w + other.w);
    sum += viscous_acceleration(c, place.xyz - other.xyz, x - args.from.at[j].xyz, weight);
  }
  for (uint k = counts.x; k < listed; ++k) {
    const uint j = args.lists.at[first + k * list_stride];
    const vec4 wall = args.boundary.at[j];
    const vec4 motion = args.boundary_motions.at[j];
    const vec3 dv = args.first != 0u ? x - motion.xyz : x;
    sum += viscous_acceleration(c, place.xyz - wall.xyz, dv, motion.w * wall.w / place.w);
  }
  precise const vec3 result = args.first != 0u ? dt * sum : x - dt * sum;
  args.to.at[i] = vec4(result, 0.0);
}
