#version 460
#include "sph/layout.h"
#include "sph/kernel.glsl"
#include "sph/lists.glsl"
#include "sph/solve.glsl"

// Velocity of a particle after the impulses of pressure; equal and opposite between particles. One
// thread a particle. Source: Bender & Koschier 2015.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { SolveArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count || args.solver.at[0].running == 0u) return;
  const SphConstants c = args.constants.at[0];
  const vec3 p = args.places.at[i].xyz;
  const float impulse = args.impulses.at[i];
  const uvec2 counts = args.counts.at[i];
  const uint listed = min(counts.y, c.capacity);
  const uint first = list_first(c.capacity, i);
  precise vec3 sum = vec3(0.0);
  for (uint k = 0u; k < counts.x; ++k) {
    const uint j = args.lists.at[first + k * list_stride];
    precise const vec3 d = p - args.places.at[j].xyz;
    precise const float strength = c.mass * (impulse + args.impulses.at[j]);
    sum += strength * kernel_gradient(c, d);
  }
  for (uint k = counts.x; k < listed; ++k) {
    const vec4 wall = args.boundary.at[args.lists.at[first + k * list_stride]];
    precise const vec3 d = p - wall.xyz;
    sum += wall.w * impulse * kernel_gradient(c, d);
  }
  precise const vec3 velocity = args.predicted.at[i].xyz - sum;
  args.moved.at[i].xyz = velocity;
}
