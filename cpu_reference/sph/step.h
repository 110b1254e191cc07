#pragma once

#include <vector>

#include "sim/sph.h"

namespace parity::cpu {

/// Steps of a fixed length from the initial state: kick, then drift. Positions and velocities add
/// up in double; forces are those between their float values. Incompressible methods go on from the
/// pressures of the state before.
///
/// @param step   s, > 0.
/// @param count  steps, >= 0.
///
/// Stable iff  the step is below 2 / omega of the fastest sound wave and below what friction
/// allows;
///             see sph_stable_step.
/// Source: notes 10.1, 10.4.
SphState sph_step(const SphProblem& problem, double step, int count);

/// s, the largest stable step for small motion about the square or cubic lattice at rest, by its
/// own waves: the largest of |sum V grad W sin(k x)| over wave vectors gives omega / c, and
/// friction of rate g adds 2 g dt + (omega dt)^2 < 4, or, implicit, (omega dt)^2 < 4 + 2 g dt.
///
/// Source: notes 10.1 (stability test), applied to notes 10.4.
double sph_stable_step(const SphParameters& parameters);

}  // namespace parity::cpu
