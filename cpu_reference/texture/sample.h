#pragma once

#include <cstdint>

#include "geometry/math.h"
#include "geometry/texture.h"

namespace parity::cpu {

using parity::MippedTexture;

/// What a lookup gives, and which discrete choices it took: two lookups with equal `choices` read
/// the same texels with continuous weights, so that they differ by continuity only.
struct TextureLookup {
  dvec4 value{0.0};           ///< linear RGBA, 0 to 1
  std::uint32_t choices = 0;  ///< a mix of nearest texels and nearest levels; 0: none taken
};

/// Linear value of an 8-bit sRGB code, 0 to 1, by the exact piecewise function.
///
/// Source: IEC 61966-2-1; Khronos Data Format Specification 1.3, 13.3.
double linear_from_srgb_code(std::uint8_t code);

/// Level of detail: log2 of the longer side of the pixel's footprint in texels of level 0.
///
/// @param uv_dx   change of (u, v) over one pixel to the right, in texture lengths.
/// @param uv_dy   the same, one pixel down.
/// @param width   texels of level 0.
/// @param height  texels of level 0.
/// @return        -inf where the footprint is a point; never NaN.
///
/// Source: Vulkan 1.3, "Scale Factor Operation, Level-of-Detail Operation".
double level_of_detail(dvec2 uv_dx, dvec2 uv_dy, int width, int height);

/// Reads a texture at (u, v): each texel decoded to linear first, then filtered. lambda <= 0 takes
/// the magnification filter at level 0, else the minification filter in the mip mode of the
/// sampler.
///
/// @param uv      texture lengths, (0, 0) the top left corner; values that are not finite read as
/// 0.
/// @param lambda  level of detail; beyond the last level: the last; NaN: magnified.
///
/// Source: notes 6.3; Vulkan 1.3, "Texel Filtering", "Wrapping Operation".
TextureLookup sample(const MippedTexture& texture, dvec2 uv, double lambda);

}  // namespace parity::cpu
