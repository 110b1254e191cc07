#include "gpu/raster/depth.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "gpu/raster/hardware_draw.h"
#include "gpu/raster/tile_rasterizer.h"
#include "gpu/raster/triangle_buffers.h"
#include "shaders.h"

namespace parity::gpu {
namespace {

DepthImage depth_image(const TriangleList& list, std::vector<float> depth,
                       std::vector<std::uint32_t> front) {
  DepthImage image{Grid<float>{list.width, list.height},
                   Grid<std::uint32_t>{list.width, list.height}};
  image.depth.values() = std::move(depth);
  image.front.values() = std::move(front);
  return image;
}

RasterOptions raster_options(const TriangleList& list, DepthMode mode) {
  return {
      .colors = {Format::r32_uint},
      .blends = {},
      .depth = Format::d32_float,
      .depth_compare = mode == DepthMode::reverse_z ? Compare::greater : Compare::less,
      .culling = culling_of(list.cull),
      .specializations = {},
  };
}

}  // namespace

DepthImage depth_test(Context& context, const TriangleList& list, DepthMode mode, float near,
                      float far, Snapping snapping) {
  const TriangleBuffers triangles(context, list, "gpu::depth_test");
  TileRasterizer rasterizer(context, {.width = list.width,
                                      .height = list.height,
                                      .samples = 1,
                                      .snapping = snapping,
                                      .depth = mode,
                                      .near = near,
                                      .far = far,
                                      .triangle_capacity = triangles.triangle_count()});
  do {
    context.run([&](Commands& commands) { rasterizer.record(commands, triangles.source()); });
  } while (!rasterizer.fit(context));
  return depth_image(list, rasterizer.depths().read(), rasterizer.elements().read());
}

DepthImage hardware_depth_test(Context& context, const TriangleList& list, DepthMode mode,
                               float near, float far) {
  const bool logarithmic = mode == DepthMode::logarithmic;
  if (logarithmic && !(near > 0 && far > near))
    throw std::invalid_argument("gpu::hardware_depth_test: near is " + std::to_string(near) +
                                ", far is " + std::to_string(far) + ", must be 0 < near < far");
  const TriangleBuffers triangles(context, list, "gpu::hardware_depth_test");
  const RasterPipeline<DrawArgs> pipeline(
      context, shaders::raster_draw_vert,
      logarithmic ? shaders::raster_draw_log_depth_frag : shaders::raster_draw_element_frag,
      raster_options(list, mode));
  const Image element_image(
      context, {.width = list.width, .height = list.height, .format = Format::r32_uint});
  const Image depth_target(
      context, {.width = list.width, .height = list.height, .format = Format::d32_float});
  const std::size_t pixels = std::size_t(list.width) * std::size_t(list.height);
  const Buffer<std::uint32_t> elements(context, pixels);
  const Buffer<float> depths(context, pixels);
  DrawArgs args = draw_args(triangles);
  args.log_scale = logarithmic ? float(-1 / std::log2(double(far) / near)) : 0;
  args.log_near = near;
  const DepthTarget depth{.image = &depth_target,
                          .clear = mode == DepthMode::reverse_z ? 0.f : 1.f};
  context.run([&](Commands& commands) {
    commands.render({.colors = {cleared(element_image)}, .depth = depth},
                    [&](RenderPass& pass) { draw_triangles(pass, pipeline, triangles, args); });
    commands.copy(element_image, elements);
    commands.copy(depth_target, depths);
  });
  return depth_image(list, depths.read(), elements.read());
}

}  // namespace parity::gpu
