#pragma once

#include <cstdint>
#include <memory>

#include "geometry/grid.h"
#include "geometry/math.h"
#include "gpu/core/context.h"

namespace parity::gpu {

enum class Format { r32_uint, r32_float, rgba8, rgba8_srgb, rgba16_float, rgba32_float, d32_float };

/// Bytes of one texel.
std::size_t texel_bytes(Format format);

struct ImageOptions {
  int width = 1;
  int height = 1;
  int levels = 1;
  int samples = 1;  ///< one of DeviceInfo::sample_counts
  Format format = Format::rgba8;
};

/// Texels on the device: colour or depth target, sampled or stored to by kernels (as far as the
/// format allows), copied. Move-only.
class Image {
 public:
  /// @throws Error  out of memory, or the device does not offer that format, size or sample count.
  Image(Context& context, const ImageOptions& options);
  ~Image();
  Image(Image&&) noexcept;
  Image& operator=(Image&&) noexcept;

  const ImageOptions& options() const;

  struct State;  // for gpu/core only
  State* state() const { return state_.get(); }

 private:
  std::unique_ptr<State> state_;
};

struct SamplerOptions {
  bool linear_mag = true;
  bool linear_min = true;
  bool linear_mip = true;
  enum class Wrap {
    repeat,
    mirrored_repeat,
    clamp_to_edge,
    clamp_to_border,
    mirror_clamp_to_edge
  } wrap_u = Wrap::repeat,
    wrap_v = Wrap::repeat;
  float lod_bias = 0;
  float min_lod = 0;
  float max_lod = 1000;
  float max_anisotropy = 1;
};

/// How a fixed-function sampler reads. Move-only.
class ImageSampler {
 public:
  /// @throws Error  missing_feature: the device cannot mirror once.
  ImageSampler(Context& context, const SamplerOptions& options);
  ~ImageSampler();
  ImageSampler(ImageSampler&&) noexcept;
  ImageSampler& operator=(ImageSampler&&) noexcept;

  struct State;  // for gpu/core only
  State* state() const { return state_.get(); }

 private:
  std::unique_ptr<State> state_;
};

/// What stands at one binding of set 0: a sampled image if it has a sampler, else a storage image.
struct ImageBinding {
  const Image* image = nullptr;
  const ImageSampler* sampler = nullptr;
  int level = 0;  ///< storage images: the mip level
};

}  // namespace parity::gpu
