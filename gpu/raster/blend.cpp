#include "gpu/raster/blend.h"

#include <stdexcept>
#include <string>

#include "gpu/core/commands.h"
#include "gpu/raster/hardware_draw.h"
#include "shaders.h"
#include "shaders/raster/layout.h"

namespace parity::gpu {
namespace {

/// All texels, layer after layer.
Buffer<vec4> upload(Context& context, const std::vector<Grid<vec4>>& layers, const char* who) {
  if (layers.empty() || layers[0].empty())
    throw std::invalid_argument(std::string(who) + ": there are no layers, or they are empty");
  std::vector<vec4> texels;
  texels.reserve(layers.size() * layers[0].size());
  for (const Grid<vec4>& layer : layers) {
    if (layer.width() != layers[0].width() || layer.height() != layers[0].height())
      throw std::invalid_argument(
          std::string(who) + ": a layer is " + std::to_string(layer.width()) + "x" +
          std::to_string(layer.height()) + ", the first is " + std::to_string(layers[0].width()) +
          "x" + std::to_string(layers[0].height()));
    texels.insert(texels.end(), layer.begin(), layer.end());
  }
  return {context, texels};
}

Grid<vec4> grid_of(const Grid<vec4>& like, const Buffer<vec4>& texels) {
  Grid<vec4> grid{like.width(), like.height()};
  grid.values() = texels.read();
  return grid;
}

Blend blend_of(BlendMode mode) {
  switch (mode) {
    case BlendMode::over:
      return Blend::source_over;
    case BlendMode::over_premultiplied:
      return Blend::premultiplied_over;
    default:
      return Blend::add;
  }
}

}  // namespace

Grid<vec4> blend(Context& context, const std::vector<Grid<vec4>>& layers, BlendMode mode) {
  const Buffer<vec4> texels = upload(context, layers, "gpu::blend");
  const auto pixels = std::uint32_t(layers[0].size());
  const Buffer<vec4> result(context, pixels);
  const Kernel<BlendArgs> kernel(context, shaders::raster_blend_comp);
  context.run([&](Commands& commands) {
    commands.dispatch(
        kernel, {pixels},
        {texels, result, pixels, std::uint32_t(layers.size()), std::uint32_t(mode), 0});
  });
  return grid_of(layers[0], result);
}

Grid<vec4> hardware_blend(Context& context, const std::vector<Grid<vec4>>& layers, BlendMode mode,
                          Format format) {
  const Buffer<vec4> texels = upload(context, layers, "gpu::hardware_blend");
  const std::size_t pixels = layers[0].size();
  const auto width = std::uint32_t(layers[0].width());
  const auto height = std::uint32_t(layers[0].height());
  const RasterPipeline<FullScreenArgs> pipeline(
      context, shaders::raster_full_screen_vert, shaders::raster_layer_frag,
      {.colors = {format}, .blends = {blend_of(mode)}, .depth = {}, .specializations = {}});
  const Kernel<FullScreenArgs> fetch(context, shaders::raster_fetch_texels_comp);
  const Image image(context,
                    {.width = layers[0].width(), .height = layers[0].height(), .format = format});
  const ImageSampler sampler(context,
                             {.linear_mag = false, .linear_min = false, .linear_mip = false});
  const Buffer<vec4> result(context, pixels);
  const ImageBinding images[] = {{&image, &sampler}};
  context.run([&](Commands& commands) {
    commands.render({.colors = {cleared(image)}, .depth = {}}, [&](RenderPass& pass) {
      for (std::size_t layer = 0; layer < layers.size(); ++layer)
        pass.draw(pipeline, {texels.ref(layer * pixels), width, height}, 3);
    });
    commands.dispatch(fetch, {std::uint32_t(pixels)}, {result, width, height}, images);
  });
  return grid_of(layers[0], result);
}

}  // namespace parity::gpu
