#pragma once

#include <cstdint>
#include <optional>

#include "geometry/grid.h"
#include "geometry/math.h"
#include "geometry/scene.h"

namespace parity::cpu {

/// Texel that a coordinate stands for; none: the border.
///
/// Source: Vulkan 1.3, "Wrapping Operation".
std::optional<int> wrap_texel(std::int64_t i, int size, Wrap wrap);

/// Linear RGBA of a texel, or of a border of zeros.
dvec4 read_texel(const Grid<u8vec4>& image, bool srgb, std::int64_t x, std::int64_t y,
                 const Sampler& sampler);

/// Coordinates so large that no texel can be told apart are kept inside of what converts to int;
/// what is not finite becomes 0.
double bounded_coordinate(double c);

}  // namespace parity::cpu
