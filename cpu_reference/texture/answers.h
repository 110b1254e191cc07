#pragma once

#include <vector>

#include "cpu_reference/texture/anisotropic.h"
#include "geometry/math.h"
#include "geometry/texture.h"

namespace parity::cpu {

/// How far a sampler may be from exact arithmetic. All errors are to both sides.
struct SamplerPrecision {
  double coordinate = 0;    ///< of u times the width, relative to 1 + |u| width
  double texel_weight = 0;  ///< of places and weights, in texels: 2^-subTexelPrecisionBits
  double level_weight = 0;  ///< of the weight between levels: 2^-mipmapPrecisionBits
  double srgb_decode = 0;   ///< of decoding, in codes of 8 bits
};

/// Colours that are right: all between two, channel by channel.
struct ColorBox {
  dvec4 low{0.0};
  dvec4 high{0.0};
};

/// Levels of detail that a sampler may take.
struct LevelRange {
  double low = 0;
  double high = 0;
};

/// The levels of detail that Vulkan allows for a footprint: the scale factor of each derivative may
/// be anything from the larger of its two components to sqrt 2 times their sum, and the logarithm
/// is taken with `bits` fraction bits.
///
/// Source: Vulkan 1.3, "Scale Factor Operation, Level-of-Detail Operation and Image Level(s)
/// Selection".
LevelRange allowed_levels(dvec2 uv_dx, dvec2 uv_dy, int width, int height, int bits);

/// All answers that a right sampler of this precision may give at (u, v): a box for each choice of
/// nearest texel, of nearest level, and of the pair of levels to mix. Isotropic.
///
/// Source: Vulkan 1.3, "Texel Filtering", "(u,v,w,a) to (i,j,k,l,n) Transformation And Array Layer
/// Selection": weights are kept with subTexelPrecisionBits, mip weights with mipmapPrecisionBits;
/// conformance 1.3.
std::vector<ColorBox> sample_answers(const MippedTexture& texture, dvec2 uv, LevelRange lambda,
                                     const SamplerPrecision& precision);

/// How far the answer over a footprint is moved when its place and derivatives are, each by its
/// error to both sides, the larger changes of all six added up.
///
/// @param place_error       texture lengths.
/// @param derivative_error  in texels, relative to the longer derivative.
dvec4 moved_by(const MippedTexture& texture, const Footprint& footprint, dvec2 place_error,
               double derivative_error);

/// How far a colour is from the nearest box, in its worst channel; 0 inside of one.
double distance_to(const std::vector<ColorBox>& answers, dvec4 color);

}  // namespace parity::cpu
