#pragma once

#include "sim/fluid.h"

namespace parity::cpu {

/// Holds smoke and temperature in the sources, and lets heat cool by 1 / (1 + cooling step).
FluidState hold_sources(const FluidProblem& problem, const FluidState& state, double seconds);

/// Adds step times force, buoyancy and vorticity confinement to the velocity; sources that move
/// hold theirs.
///
/// Source: notes 10.4; Fedkiw, Stam & Jensen 2001.
FluidState push(const FluidProblem& problem, const FluidState& state, double seconds);

}  // namespace parity::cpu
