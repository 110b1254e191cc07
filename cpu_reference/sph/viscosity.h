#pragma once

#include <vector>

#include "sim/sph.h"

namespace parity::cpu {

/// Velocities at the end of an implicit step of viscosity that begins with `velocities`, m/s, in
/// the order of the particles.
///
/// @param densities   kg/m^3, as many as particles.
/// @param velocities  m/s, as many.
/// @param step        s, >= 0.
///
/// Stable for any step and viscosity: they minimise half the square of their change plus what they
/// dissipate.
/// Accuracy: of the solve 1e-12; O(step) in time.
/// Source: Weiler, Koschier, Brand & Bender 2018; Monaghan 2005.
std::vector<dvec3> sph_viscous_velocities(const SphProblem& problem,
                                          const SphNeighbourLists& neighbours,
                                          const std::vector<double>& densities,
                                          const std::vector<dvec3>& velocities, double step);

}  // namespace parity::cpu
