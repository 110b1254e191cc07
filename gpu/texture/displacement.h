#pragma once

#include "geometry/displacement.h"
#include "gpu/core/context.h"

namespace parity::gpu {

/// Cuts and displaces. Mathematics: cpu::displace. Points of shared edges are equal bit by bit, so
/// that no cracks open.
///
/// @throws std::invalid_argument  corners not in threes, or no height map.
DisplacedMesh displace(Context& context, const DisplacementProblem& problem);

}  // namespace parity::gpu
