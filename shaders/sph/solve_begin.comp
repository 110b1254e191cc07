#version 460
#include "sph/layout.h"
#include "sph/rounds.glsl"
#include "sph/kernel.glsl"
#include "sph/lists.glsl"
#include "sph/solve.glsl"

// Velocities without pressure, pressures to begin with, and the diagonal of the system: how a
// particle's own pressure lowers its rate of density. The divergence solve begins with the velocities
// as they are. One thread a particle; the first also starts
// the solver. Source: Bender & Koschier 2015.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { SolveBeginArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  const SphConstants c = args.constants.at[0];
  const float dt = args.clock.at[0].step;
  if (i == 0u) {
    args.solver.at[0] = SphSolver(dt > 0.0 ? 1u : 0u, 0u, 0.0, 0.0);
    set_rounds(args.groups, dt > 0.0, args.count, args.block);
  }
  const vec4 place = args.places.at[i];
  const uvec2 counts = args.counts.at[i];
  const uint listed = min(counts.y, c.capacity);
  const uint first = list_first(c.capacity, i);
  precise vec3 sum = vec3(0.0);
  precise float squares = 0.0;
  for (uint k = 0u; k < counts.x; ++k) {
    const uint j = args.lists.at[first + k * list_stride];
    precise const vec3 d = place.xyz - args.places.at[j].xyz;
    precise const vec3 g = c.mass * kernel_gradient(c, d);
    sum += g;
    squares += squared_length(g);
  }
  for (uint k = counts.x; k < listed; ++k) {
    const vec4 wall = args.boundary.at[args.lists.at[first + k * list_stride]];
    precise const vec3 d = place.xyz - wall.xyz;
    sum += wall.w * kernel_gradient(c, d);
  }
  precise const float diagonal = squared_length(sum) + squares;
  const vec3 start = args.motions.at[i].xyz;
  precise const vec3 kicked = start + dt * args.accelerations.at[i].xyz;
  const vec3 velocity = args.divergence != 0u ? start : kicked;
  args.predicted.at[i] = vec4(velocity, diagonal > 0.0 ? 1.0 / diagonal : 0.0);
  precise const float impulse = dt * args.pressures.at[args.ids.at[i]] / (place.w * place.w);
  args.impulses.at[i] = args.divergence != 0u ? 0.0 : impulse;
}
