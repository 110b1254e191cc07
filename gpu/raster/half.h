#pragma once

#include <cstdint>
#include <vector>

#include "geometry/math.h"

namespace parity::gpu {

/// The exact value of a half-precision number (IEEE 754 binary16).
float float_from_half(std::uint16_t half);

/// Pixels of RGBA16F, two words a pixel, red in the lowest bits.
std::vector<vec4> vec4_from_halves(const std::vector<std::uint32_t>& words);

/// Pixels of RGBA32F, four words a pixel.
std::vector<vec4> vec4_from_floats(const std::vector<std::uint32_t>& words);

}  // namespace parity::gpu
