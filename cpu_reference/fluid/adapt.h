#pragma once

#include "sim/fluid.h"
#include "sim/step_control.h"

namespace parity::cpu {

/// s that the fastest flow and viscosity allow.
///
/// Source: notes 10.4 (CFL); row 169 for viscosity.
double stable_step(const FluidProblem& problem, const FluidState& state);

/// The state after two half steps, and how far one whole step ends from it: the largest difference
/// of a face, as a part of the largest speed, by step_error.
struct DoubledStep {
  FluidState state;
  double error = 0;
};
DoubledStep doubled_step(const FluidProblem& problem, const FluidState& state, double seconds);

/// One step, at most to `until`, whose error is at most parameters.step_error; repeated from the
/// same state until it is. Not for liquids.
FluidState adaptive_step(const FluidProblem& problem, const FluidState& state, StepControl& control,
                         double until);

}  // namespace parity::cpu
