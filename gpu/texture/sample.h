#pragma once

#include <span>
#include <vector>

#include "geometry/texture.h"
#include "gpu/core/context.h"
#include "gpu/core/image.h"
#include "shaders/texture/layout.h"

namespace parity::gpu {

/// Linear RGBA of a texture at footprints, one each, by the sampler in software that the renderer
/// runs.
///
/// @throws std::invalid_argument  there is no level, or one is empty.
///
/// Mathematics: cpu::sample at the level of detail of the footprint. Float: coordinates are off by
/// 2^-23 of their size in texels, levels of detail by 2^-21 + 6 |lambda| 2^-24, weights and sums by
/// 16 2^-24.
/// `level_bias`: cpu::sample's, of anisotropic samplers.
std::vector<vec4> sample(Context& context, const MippedTexture& texture,
                         std::span<const TextureFootprint> footprints, float level_bias);

/// The same through the device's sampler: in a compute shader, or, if the sampler is anisotropic,
/// in a fragment shader, as drivers may need. `format` is rgba8 or rgba8_srgb, or rgba32_float of
/// the decoded texels.
std::vector<vec4> hardware_sample(Context& context, const MippedTexture& texture,
                                  std::span<const TextureFootprint> footprints, Format format);

}  // namespace parity::gpu
