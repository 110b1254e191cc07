#pragma once

#include <vector>

#include "sim/sph.h"

namespace parity::cpu {

/// The particles and the wall particles closer than the support to each particle. The decision
/// r^2 < H^2 is made in float, as the device makes it.
///
/// @throws std::invalid_argument  as check_sph_problem.
///
/// Source: notes 10.4; found by a sweep along x, in n log n + n sqrt n steps for even fluids.
SphNeighbourLists sph_neighbours(const SphProblem& problem);

/// The same of particles anywhere.
SphNeighbourLists sph_neighbours(const std::vector<vec3>& fluid, const std::vector<vec3>& walls,
                                 float support);

}  // namespace parity::cpu
