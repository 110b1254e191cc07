#pragma once

#include <vector>

#include "geometry/grid.h"
#include "geometry/math.h"

namespace parity {

/// An image and its ever smaller versions down to 1x1.
///
/// @param image  level 0, 8-bit RGBA, at least 1x1.
/// @param srgb   RGB is stored in sRGB: averages are taken in linear light and stored in sRGB
/// again.
/// @return       levels 0..n; sides of level k + 1 are max(1, floor(side / 2)). Each texel is the
///               mean over the box that it covers in the level above it, exact for odd sides too.
/// @throws std::invalid_argument  the image is empty.
///
/// Source: notes 6.3; Vulkan 1.3, "Image Mip Level Sizing".
std::vector<Grid<u8vec4>> mip_pyramid(const Grid<u8vec4>& image, bool srgb);

}  // namespace parity
