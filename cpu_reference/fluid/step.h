#pragma once

#include "sim/fluid.h"

namespace parity::cpu {

/// One step of `seconds`, by the method of the problem: upwind and central with the Runge-Kutta
/// method of order 3 of Shu & Osher, projecting after each stage; the others split into advection,
/// viscosity, forces and projection. Not for liquids: those are cpu::liquid_step.
///
/// Accuracy: central O(h^2 + step^3) in velocity; split methods O(h^2 / step + step).
/// Source: notes 10.4; Chorin 1968; Shu & Osher 1988.
FluidState step(const FluidProblem& problem, const FluidState& state, double seconds);

/// Steps of the same length to a time.
FluidState run(const FluidProblem& problem, FluidState state, double seconds, int count);

}  // namespace parity::cpu
