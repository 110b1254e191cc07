#pragma once

#include <vector>

#include "sim/sph.h"

namespace parity::cpu {

/// What pressure makes of the velocities of one step, and the pressures.
struct SphPressed {
  std::vector<dvec3> velocities;  ///< m/s, in the order of the particles
  std::vector<double> pressures;  ///< Pa
};

/// Velocities after one step of length dt under which no particle is predicted to be denser than at
/// rest: the matrix of the particles' rates of density is written down, and half Jacobi steps are
/// taken on the pressures, which stay >= 0, from those of the state (none: 0), until the average
/// compression is within the parameters' density error and the largest within ten times that, or
/// their iterations are over. With SphMethod::divergence_free the same is done before for the rate
/// of density of particles inside the fluid, from no pressure.
///
/// @param densities   kg/m^3, as many as particles.
/// @param velocities  m/s, as many, at the beginning of the step.
///
/// Converges: the matrix is symmetric and positive semi-definite; towards the projection of the
/// velocities on those that compress nothing.
/// Source: Bender & Koschier 2015, 2017; Ihmsen et al. 2014 (the matrix).
SphPressed sph_pressed_velocities(const SphProblem& problem, const SphNeighbourLists& neighbours,
                                  const std::vector<double>& densities,
                                  const std::vector<dvec3>& velocities, double dt);

/// The same from the initial state, over the parameters' fixed step.
SphPressed sph_incompressible_velocities(const SphProblem& problem);

}  // namespace parity::cpu
