#version 460
#include "numerics/layout.h"
#include "fluid/layout.h"

// Begins a pressure solve, or notes how it ended; one thread. The divergence asked for becomes a
// residual: sim/pressure.h.
layout(local_size_x = 1) in;
layout(scalar, push_constant) uniform Push { FluidProjectArgs args; };

void main() {
  const float step = args.part * args.clock.at[0].step;
  if (args.mode == 1u) {
    if (step > 0.0 && args.control.at[0].done == 0u) args.clock.at[0].unconverged += 1u;
    return;
  }
  FluidScene scene = args.scene.at[0];
  SolverControl control;
  control.done = step == 0.0 ? 1u : 0u;
  control.iterations = 0u;
  control.residual = 0.0;
  control.tolerance =
      scene.divergence * scene.density * scene.spacing * scene.spacing / max(step, 1e-30);
  control.rho = 0.0;
  control.alpha = 0.0;
  control.beta = 0.0;
  control.mean = 0.0;
  args.control.at[0] = control;
}
