#version 460
#include "sph/layout.h"
#include "sph/rounds.glsl"

// Stops the solver where the average compression is within the tolerance and the largest within ten
// times that, but not before the least rounds; one thread.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { SolveCheckArgs args; };

void main() {
  if (gl_GlobalInvocationID.x != 0u || args.solver.at[0].running == 0u) return;
  const uint blocks = (args.count + args.block - 1u) / args.block;
  precise float sum = 0.0;
  float largest = 0.0;
  for (uint block = 0u; block < blocks; ++block) {
    const vec2 other = args.sums.at[block];
    sum += other.x;
    largest = max(largest, other.y);
  }
  SphSolver solver = args.solver.at[0];
  solver.iterations += 1u;
  solver.average = sum / float(args.count);
  solver.largest = largest;
  if (solver.iterations >= args.least && solver.average <= args.tolerance &&
      largest <= 10.0 * args.tolerance) {
    solver.running = 0u;
    stop_rounds(args.groups);
  }
  args.solver.at[0] = solver;
}
