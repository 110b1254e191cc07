#pragma once

#include "sim/fluid.h"

namespace parity::cpu {

/// Velocity without divergence, to the tolerance of the parameters, and the pressure that makes it
/// so: u - step / density * gradient of p. Closed faces move with what closes them.
///
/// @param seconds  the step, > 0.
/// Accuracy: the pressure's gradient is of order 2 on open faces.
/// Source: notes 10.4; Chorin 1968; Batty, Bertails & Bridson 2007.
FluidState project(const FluidProblem& problem, const FluidState& state, double seconds);

}  // namespace parity::cpu
