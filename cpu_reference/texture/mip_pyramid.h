#pragma once

#include <vector>

#include "geometry/grid.h"
#include "geometry/math.h"

namespace parity::cpu {

/// An image and its ever smaller versions down to 1x1, as stored values before they are rounded:
/// sRGB display values times 255 (alpha: linear times 255).
///
/// @param image  level 0, 8-bit RGBA, at least 1x1.
/// @param srgb   RGB is stored in sRGB: averages are taken in linear light.
/// @return       levels 0..n of mip_levels. Each texel is the mean over the box that it covers in
///               the level above it, before that was rounded; exact for odd sides too.
/// @throws std::invalid_argument  the image is empty.
///
/// Source: notes 6.3; Vulkan 1.3, "Image Mip Level Sizing".
/// Erratum: the notes halve sides without a word on odd ones; the mean of 2x2 texels then leaves
/// out the last column, and the weights here are the overlaps of the boxes.
std::vector<Grid<dvec4>> mip_means(const Grid<u8vec4>& image, bool srgb);

/// mip_means rounded to the next code.
std::vector<Grid<u8vec4>> mip_pyramid(const Grid<u8vec4>& image, bool srgb);

/// Stored values that a right builder with an error of `error` codes may round otherwise: the same
/// pyramid with each texel rounded as if its mean were that much less (or more, if negative).
std::vector<Grid<u8vec4>> round_pyramid(const std::vector<Grid<dvec4>>& means, double error);

}  // namespace parity::cpu
