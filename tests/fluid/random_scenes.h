#pragma once

#include <algorithm>
#include <cmath>

#include "gpu/fluid/step.h"

/// Random fluids under the adaptive step, held to what forces and walls can give.
namespace parity {

/// The largest square root of the kinetic energy in a run of `seconds`, over the most that it may
/// be: forces f and walls that slide at w give ||u(t)|| <= ||u(0)|| + (t |f| + w) sqrt(V), in the
/// L2 norm, as advection and projection keep or lose energy. Infinite where a value is not finite.
inline double speed_over_bound(gpu::Context& context, const FluidProblem& problem, double seconds) {
  const FluidDomain& domain = problem.domain;
  const FluidMeasures first = measure(problem, problem.initial);
  const double volume = double(domain.cell_count()) * std::pow(domain.spacing, 3);
  const double mass =
      is_liquid(problem.parameters.method) ? first.mass : volume * problem.parameters.density;
  double walls = 0;
  for (const Wall& wall : domain.walls) walls = std::max(walls, glm::length(wall.velocity));
  for (const FluidSolid& solid : problem.solids)
    walls = std::max(walls, glm::length(solid.velocity));
  gpu::FluidSimulation simulation(context, problem);
  double largest = 0;
  constexpr int parts = 5;
  for (int k = 1; k <= parts; ++k) {
    const double time = seconds * k / parts;
    // Steps that do not end are no run either.
    const FluidClock clock = simulation.run_until(time, 8, 20000);
    const double energy = measure(problem, simulation.read()).kinetic_energy;
    if (!std::isfinite(energy) || double(clock.time) < 0.99 * time) return INFINITY;
    const double given = glm::length(problem.parameters.force) * time + walls;
    largest = std::max(largest, std::sqrt(energy) / (std::sqrt(first.kinetic_energy) +
                                                     std::sqrt(mass / 2) * given));
  }
  return largest;
}

}  // namespace parity
