#pragma once

#include <vector>

#include "sim/sph.h"

namespace parity::cpu {

/// Gradients of the velocities, 1/s, in the order of the particles; columns: derivatives along x,
/// y, z. From the fluid's particles alone.
///
/// @param densities  kg/m^3, as many as particles.
///
/// Exact for linear fields wherever neighbours do not lie in a plane (2 dimensions: in a line);
/// where they do, 0: where the determinant of their moments is below 5 % of the cube of their mean.
/// Source: Randles & Libersky 1996; Bonet & Lok 1999.
/// Differs from the papers: written as the least squares fit of a linear field that it is, with the
/// weights -W'(r) / r times the volumes.
std::vector<dmat3> sph_velocity_gradients(const SphProblem& problem,
                                          const SphNeighbourLists& neighbours,
                                          const std::vector<double>& densities);

}  // namespace parity::cpu
