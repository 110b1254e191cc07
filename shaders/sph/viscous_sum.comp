#version 460
#include "sph/layout.h"
#include "sph/kernel.glsl"

// The inner products of conjugate gradients over a block, in order; one thread a block. Source:
// Chronopoulos & Gear 1989.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { ViscousSumArgs args; };

void main() {
  const uint block = gl_GlobalInvocationID.x;
  const uint first = block * args.block;
  if (first >= args.count || args.solver.at[0].running == 0u) return;
  const uint last = min(first + args.block, args.count);
  precise vec3 sum = vec3(0.0);
  for (uint i = first; i < last; ++i) {
    const vec3 r = args.residual.at[i].xyz;
    sum += vec3(squared_length(r), inner_product(r, args.product.at[i].xyz),
                squared_length(args.solution.at[i].xyz));
  }
  args.sums.at[block] = sum;
}
