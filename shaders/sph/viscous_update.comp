#version 460
#include "sph/layout.h"

// A step of conjugate gradients; one thread a particle. Source: Chronopoulos & Gear 1989.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { ViscousUpdateArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count || args.solver.at[0].running == 0u) return;
  const float alpha = args.solver.at[0].alpha;
  const float beta = args.solver.at[0].beta;
  precise const vec4 direction = args.residual.at[i] + beta * args.direction.at[i];
  precise const vec4 image = args.product.at[i] + beta * args.image.at[i];
  precise const vec4 solution = args.solution.at[i] + alpha * direction;
  precise const vec4 residual = args.residual.at[i] - alpha * image;
  args.direction.at[i] = direction;
  args.image.at[i] = image;
  args.solution.at[i] = solution;
  args.residual.at[i] = residual;
}
