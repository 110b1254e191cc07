#pragma once

#include <vector>

#include "sim/sph.h"

namespace parity::cpu {

/// What pressure makes of the velocities of one step, and the pressures.
struct SphPressed {
  std::vector<dvec3> velocities;  ///< m/s, in the order of the particles
  std::vector<double> pressures;  ///< Pa
};

/// Velocities after one step of the parameters' fixed length under which no particle is predicted
/// to be denser than at rest: the matrix of the particles' rates of density is written down, and
/// half a Jacobi step is taken `rounds` times on the pressures, which stay >= 0, from 0.
///
/// Converges: the matrix is symmetric and positive semi-definite; towards the projection of the
/// velocities on those that compress nothing.
/// Source: Bender & Koschier 2015; Ihmsen et al. 2014 (the matrix).
SphPressed sph_incompressible_velocities(const SphProblem& problem, int rounds);

}  // namespace parity::cpu
