#pragma once

#include <cstdint>
#include <vector>

#include "geometry/math.h"
#include "geometry/sampling.h"
#include "gpu/core/context.h"

namespace parity::gpu {

/// Samples of a pixel, in [0, 1)^2.
///
/// @throws std::invalid_argument  count is 0 or above 2^20; blue noise: above 4096.
///
/// Mathematics: cpu::pattern. Precision: 2^-23; blue noise and sobol are equal to the reference.
std::vector<vec2> pattern(Context& context, SamplePattern pattern, std::uint32_t count,
                          std::uint32_t seed);

}  // namespace parity::gpu
