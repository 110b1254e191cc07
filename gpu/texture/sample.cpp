#include "gpu/texture/sample.h"

#include <algorithm>
#include <array>
#include <bit>
#include <stdexcept>
#include <string>

#include "geometry/color.h"
#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "shaders.h"
#include "shaders/raster/scene_layout.h"

namespace parity::gpu {
namespace {

constexpr std::uint32_t borders_constant = 20, level_bias_constant = 21;

void check(const MippedTexture& texture, const char* who) {
  if (texture.levels.empty()) throw std::invalid_argument(std::string(who) + ": no levels");
  for (std::size_t i = 0; i < texture.levels.size(); ++i)
    if (texture.levels[i].empty())
      throw std::invalid_argument(std::string(who) + ": level " + std::to_string(i) + " is empty");
}

std::vector<std::uint32_t> pack(std::span<const Grid<u8vec4>> levels) {
  std::vector<std::uint32_t> words(levels.size());
  for (std::size_t i = 0; i < levels.size(); ++i) {
    words[i] = std::uint32_t(words.size());
    for (const u8vec4& c : levels[i])
      words.push_back(std::uint32_t(c.x) | std::uint32_t(c.y) << 8 | std::uint32_t(c.z) << 16 |
                      std::uint32_t(c.w) << 24);
  }
  return words;
}

std::uint32_t flags_of(const MippedTexture& texture) {
  const Sampler& s = texture.sampler;
  std::uint32_t flags = texture.srgb ? texture_base_color : texture_normal;
  const auto wrap = [](parity::Wrap mode) {
    return std::uint32_t(mode == parity::Wrap::mirror_clamp_to_edge ? parity::Wrap::clamp_to_edge
                                                                    : mode);
  };
  flags |= wrap(s.wrap_u) << texture_wrap_u_shift | wrap(s.wrap_v) << texture_wrap_v_shift;
  if (s.wrap_u == parity::Wrap::mirror_clamp_to_edge) flags |= texture_mirror_once_u;
  if (s.wrap_v == parity::Wrap::mirror_clamp_to_edge) flags |= texture_mirror_once_v;
  if (s.mag == Filter::linear) flags |= texture_linear_mag;
  if (s.min == Filter::linear) flags |= texture_linear_min;
  if (s.mip == Filter::nearest) flags |= texture_mip_nearest;
  if (s.mip == Filter::linear) flags |= texture_mip_linear;
  if (s.mag == Filter::linear && s.min == Filter::linear && s.mip == Filter::linear)
    flags |= std::uint32_t(std::clamp(s.max_anisotropy, 1, 16)) << texture_anisotropy_shift;
  return flags;
}

std::vector<float> srgb_table() {
  std::vector<float> table(256);
  for (std::size_t code = 0; code < 256; ++code)
    table[code] = float(linear_from_srgb(double(code) / 255.0));
  return table;
}

vec4 decoded(u8vec4 texel, bool srgb) {
  const vec4 value = vec4(texel) / 255.0f;
  if (!srgb) return value;
  return {linear_from_srgb(value.x), linear_from_srgb(value.y), linear_from_srgb(value.z), value.w};
}

Image upload(Context& context, const MippedTexture& texture, Format format) {
  const Grid<u8vec4>& first = texture.levels[0];
  Image image(context, {.width = first.width(),
                        .height = first.height(),
                        .levels = int(texture.levels.size()),
                        .format = format});
  for (std::size_t i = 0; i < texture.levels.size(); ++i) {
    const Grid<u8vec4>& level = texture.levels[i];
    if (format != Format::rgba32_float) {
      const Buffer<u8vec4> texels(context, level.values());
      context.run([&](Commands& commands) { commands.copy(texels, image, int(i)); });
      continue;
    }
    std::vector<vec4> linear;
    for (const u8vec4& texel : level) linear.push_back(decoded(texel, texture.srgb));
    const Buffer<vec4> texels(context, linear);
    context.run([&](Commands& commands) { commands.copy(texels, image, int(i)); });
  }
  return image;
}

SamplerOptions sampler_options(const Sampler& s) {
  using Wrap = SamplerOptions::Wrap;
  const auto wrap = [](parity::Wrap mode) {
    switch (mode) {
      case parity::Wrap::repeat:
        return Wrap::repeat;
      case parity::Wrap::mirrored_repeat:
        return Wrap::mirrored_repeat;
      case parity::Wrap::clamp_to_edge:
        return Wrap::clamp_to_edge;
      case parity::Wrap::mirror_clamp_to_edge:
        return Wrap::mirror_clamp_to_edge;
      default:
        return Wrap::clamp_to_border;
    }
  };
  // Vulkan's way to leave out the mip levels is a maximum just above 0, where the choice between
  // magnification and minification stays.
  return {.linear_mag = s.mag == Filter::linear,
          .linear_min = s.min == Filter::linear,
          .linear_mip = s.mip == Filter::linear,
          .wrap_u = wrap(s.wrap_u),
          .wrap_v = wrap(s.wrap_v),
          .max_lod = s.mip ? 1000.0f : 0.25f,
          .max_anisotropy = float(s.max_anisotropy)};
}

using Footprints = Buffer<TextureFootprint>;

std::vector<vec4> dispatch_lookups(Context& context, const Footprints& places,
                                   std::span<const ImageBinding> images) {
  const Buffer<vec4> colors(context, places.count());
  const Kernel<HardwareSampleArgs> kernel(context, shaders::texture_hardware_sample_comp);
  const auto count = std::uint32_t(places.count());
  context.run([&](Commands& commands) {
    commands.dispatch(kernel, {count}, {places, colors, count, 0}, images);
  });
  return colors.read();
}

/// A quad of pixels a footprint.
std::vector<vec4> draw_lookups(Context& context, const Footprints& places,
                               std::span<const ImageBinding> images) {
  constexpr std::size_t row = 256;
  if (places.count() == 0) return {};
  const std::size_t rows = (places.count() + row - 1) / row;
  const Format format = Format::rgba32_float;
  const Image target(context, {.width = 2 * row, .height = int(2 * rows), .format = format});
  const Buffer<vec4> pixels(context, 4 * row * rows);
  const RasterPipeline<HardwareSampleArgs> pipeline(
      context, shaders::raster_full_screen_vert, shaders::texture_hardware_sample_frag,
      {.colors = {format}, .blends = {}, .depth = {}, .specializations = {}});
  const HardwareSampleArgs args{places, {}, std::uint32_t(places.count()), row};
  context.run([&](Commands& commands) {
    commands.render(
        {.colors = {{.image = &target, .clear = std::array<float, 4>{}, .resolve = nullptr}},
         .depth = {}},
        [&](RenderPass& pass) {
          pass.bind(images);
          pass.draw(pipeline, args, 3);
        });
    commands.copy(target, pixels);
  });
  const std::vector<vec4> all = pixels.read();
  std::vector<vec4> colors;
  for (std::size_t i = 0; i < places.count(); ++i)
    colors.push_back(all[(i / row) * 4 * row + 2 * (i % row)]);
  return colors;
}

}  // namespace

std::vector<vec4> sample(Context& context, const MippedTexture& texture,
                         std::span<const TextureFootprint> footprints, float level_bias) {
  check(texture, "gpu::sample");
  const Buffer<std::uint32_t> texels(context, pack(texture.levels));
  const Buffer<float> linear(context, srgb_table());
  const Buffer<TextureFootprint> places(context, footprints);
  const Buffer<vec4> colors(context, footprints.size());
  const Kernel<TextureSampleArgs> kernel(
      context, shaders::texture_sample_comp,
      {{borders_constant, 1u}, {level_bias_constant, std::bit_cast<std::uint32_t>(level_bias)}});
  const auto count = std::uint32_t(footprints.size());
  context.run([&](Commands& commands) {
    commands.dispatch(kernel, {count},
                      {texels, linear, places, colors, std::uint32_t(texture.levels[0].width()),
                       std::uint32_t(texture.levels[0].height()),
                       std::uint32_t(texture.levels.size()), flags_of(texture), count, 0});
  });
  return colors.read();
}

std::vector<vec4> hardware_sample(Context& context, const MippedTexture& texture,
                                  std::span<const TextureFootprint> footprints, Format format) {
  check(texture, "gpu::hardware_sample");
  const Image image = upload(context, texture, format);
  const ImageSampler sampler(context, sampler_options(texture.sampler));
  const Buffer<TextureFootprint> places(context, footprints);
  const ImageBinding images[] = {{.image = &image, .sampler = &sampler}};
  return texture.sampler.max_anisotropy > 1 ? draw_lookups(context, places, images)
                                            : dispatch_lookups(context, places, images);
}

}  // namespace parity::gpu
