#pragma once

#include <vector>

#include "geometry/shadow.h"
#include "gpu/core/context.h"

namespace parity::gpu {

/// Share of the light that reaches each point.
///
/// @throws std::invalid_argument  maps of several sizes or not square, a radius outside 0..8.
///
/// Mathematics: cpu::shadow_map.
std::vector<float> shadow_map(Context& context, const ShadowProblem& problem);

}  // namespace parity::gpu
