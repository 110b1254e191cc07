#version 460
#include "sph/layout.h"
#include "sph/kernel.glsl"
#include "sph/lists.glsl"
#include "sph/solve.glsl"

// The compression that a particle's velocity leads to (of the divergence solve: that it adds), and
// the pressure that would undo half of it; never below 0. One thread a particle. Source: Bender & Koschier 2015, 2017 with relaxed Jacobi
// steps as in Ihmsen et al. 2014.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { SolveArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count || args.solver.at[0].running == 0u) return;
  const SphConstants c = args.constants.at[0];
  const float dt = args.clock.at[0].step;
  const vec4 place = args.places.at[i];
  const vec3 v = args.moved.at[i].xyz;
  const uvec2 counts = args.counts.at[i];
  const uint listed = min(counts.y, c.capacity);
  const uint first = list_first(c.capacity, i);
  precise float rate = 0.0;
  for (uint k = 0u; k < counts.x; ++k) {
    const uint j = args.lists.at[first + k * list_stride];
    precise const vec3 d = place.xyz - args.places.at[j].xyz;
    precise const vec3 dv = v - args.moved.at[j].xyz;
    rate += c.mass * inner_product(dv, kernel_gradient(c, d));
  }
  for (uint k = counts.x; k < listed; ++k) {
    const vec4 wall = args.boundary.at[args.lists.at[first + k * list_stride]];
    precise const vec3 d = place.xyz - wall.xyz;
    rate += wall.w * inner_product(v, kernel_gradient(c, d));
  }
  // Where particles are few, as at surfaces and in spray, they may draw near.
  const bool is_inside = place.w >= inside_density * c.rest_density;
  precise const float ahead = (place.w - c.rest_density) + dt * rate;
  precise const float excess = args.divergence == 0u ? ahead : is_inside ? dt * rate : 0.0;
  precise const float change = 0.5 * args.predicted.at[i].w * excess / dt;
  args.impulses.at[i] = max(args.impulses.at[i] + change, 0.0);
  args.moved.at[i].w = max(excess, 0.0) / c.rest_density;
}
