#pragma once

#include "cpu_reference/texture/sample.h"

namespace parity::cpu {

/// A pixel's place in a texture and what it changes to the next pixel right and down, in texture
/// lengths.
struct Footprint {
  dvec2 uv{0.0};
  dvec2 dx{0.0};
  dvec2 dy{0.0};
};

/// The ellipse that a disc of one pixel radius becomes in the texture.
struct FootprintAxes {
  double major = 0;  ///< half axis, texels
  double minor = 0;
  dvec2 direction{1, 0};  ///< of the major axis, unit
};

/// @param width, height  of the level in whose texels the axes are.
///
/// Source: singular values of a 2x2 matrix in closed form (Blinn 1996, "Consider the lowly 2x2
/// matrix").
FootprintAxes footprint_axes(dvec2 uv_dx, dvec2 uv_dy, int width, int height);

/// Of the level that an ellipse is averaged in, from the logarithm of its minor half axis. Higher
/// reads fewer texels.
constexpr double anisotropic_level_bias = 0.5;

/// Reads a texture over a footprint. If the sampler's max_anisotropy N is above 1 and all its
/// filters are linear: the mean over the ellipse, with weights (1 - r^2)^2 at r of its radius, of
/// texels of the level in which its minor half axis is 0.7 to 1.4 texels; an ellipse longer than N
/// times its width is made wider; 0.6 texels^2 are added to the squares of both half axes, so that
/// some texel is always inside. Continuous in the footprint: over the last quarter of a level's
/// range the next is mixed in, and while the major half axis grows from 1 to sqrt 2 texels the
/// bilinear filter is mixed out. Else, at the level of detail of the footprint.
///
/// Source: notes 6.3; Heckbert 1989, "Fundamentals of Texture Mapping and Image Warping", 3.5.
/// Differs: the weights, and the continuity.
TextureLookup sample(const MippedTexture& texture, const Footprint& footprint, double level_bias);
inline TextureLookup sample(const MippedTexture& texture, const Footprint& footprint) {
  return sample(texture, footprint, anisotropic_level_bias);
}

/// Does `sample` average over an ellipse?
bool is_anisotropic(const Sampler& sampler);

/// Texels that `sample` reads.
int texels_read(const MippedTexture& texture, const Footprint& footprint, double level_bias);

/// The truth that filters are judged by: all texels of level 0 under the footprint's ellipse,
/// weighted by exp(-2 r^2) - exp(-2) at r of its radius. The ellipse has the matrix J J^T + I, in
/// texels, where J maps pixels to texels: the pixel's disc and the texel's own.
///
/// Source: Heckbert 1989, 3.5.
/// Cost: pi a b texels.
dvec4 elliptical_weighted_average(const MippedTexture& texture, const Footprint& footprint);

}  // namespace parity::cpu
