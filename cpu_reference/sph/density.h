#pragma once

#include <vector>

#include "sim/sph.h"

namespace parity::cpu {

/// kg/m^3, in the order of the particles: sum of m W over the fluid, itself too, and of
/// rho_0 V W over the walls.
///
/// Source: notes 10.4; Akinci et al. 2012.
std::vector<double> sph_densities(const SphProblem& problem, const SphNeighbourLists& neighbours);

/// m^3 of fluid that each wall particle stands for: 1 / sum of W over the walls, itself too, times
/// a share.
///
/// Source: Akinci et al. 2012.
/// Differs from the paper: the share makes fluid on its lattice, a spacing from a flat wall, have
/// its rest density; without it, it would be 7 % too dense in 2 dimensions.
std::vector<double> sph_wall_volumes(const SphProblem& problem);

/// Pa; negative pressure counts as 0, or particles clump.
///
/// Source: notes 10.4 with k = c^2 (linear); Monaghan 1994 (Tait).
double sph_pressure(const SphParameters& parameters, double density);

}  // namespace parity::cpu
