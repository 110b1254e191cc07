#pragma once

#include <vector>

#include "sim/sph.h"

namespace parity::cpu {

/// m/s^2, in the order of the particles: pressure of the equation of state, viscosities, surface
/// tension, walls and gravity. Forces between particles are equal and opposite.
///
/// @param densities  kg/m^3, as many as particles.
///
/// Source: notes 10.4; Monaghan 1992 (pressure, artificial viscosity), 2005 (laminar viscosity);
/// Becker & Teschner 2007 (surface tension); Akinci et al. 2012 (walls).
/// Differs from Monaghan 1992: the artificial viscosity takes the speed of sound at rest, and no
/// quadratic term.
std::vector<dvec3> sph_accelerations(const SphProblem& problem, const SphNeighbourLists& neighbours,
                                     const std::vector<double>& densities);

/// What the equation of state does not give: the same without pressure.
std::vector<dvec3> sph_other_accelerations(const SphProblem& problem,
                                           const SphNeighbourLists& neighbours,
                                           const std::vector<double>& densities);

}  // namespace parity::cpu
