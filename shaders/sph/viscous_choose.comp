#version 460
#include "sph/layout.h"
#include "sph/rounds.glsl"

// Stops conjugate gradients at the tolerance, or chooses how far to go next; one thread. All
// eigenvalues are at least 1, so the residual bounds the error. Source: Chronopoulos & Gear 1989.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { ViscousSumArgs args; };

void main() {
  if (gl_GlobalInvocationID.x != 0u || args.solver.at[0].running == 0u) return;
  const uint blocks = (args.count + args.block - 1u) / args.block;
  precise vec3 sum = vec3(0.0);
  for (uint block = 0u; block < blocks; ++block) sum += args.sums.at[block];
  SphViscous solver = args.solver.at[0];
  precise const float bound = args.tolerance * args.tolerance * sum.z;
  precise const float beta = solver.iterations > 0u ? sum.x / solver.gamma : 0.0;
  precise const float curved =
      solver.iterations > 0u ? sum.y - beta * sum.x / solver.alpha : sum.y;
  solver.gamma = sum.x;
  solver.square = sum.z;
  if (sum.x <= bound || !(curved > 0.0)) {
    solver.running = 0u;
    stop_rounds(args.groups);
  } else {
    solver.alpha = sum.x / curved;
    solver.beta = beta;
    solver.iterations += 1u;
  }
  args.solver.at[0] = solver;
}
