#pragma once

#include "shaders/sph/layout.h"
#include "sim/sph.h"

namespace parity::gpu {

/// What the kernels need to know of a problem, with bounds of the rates that limit its step: those
/// of a fluid at rest density whose neighbours are where they hurt most.
///
/// @throws std::invalid_argument  as check_sph_problem.
SphConstants sph_constants(const SphProblem& problem);

}  // namespace parity::gpu
