#include "gpu/raster/interpolate.h"

#include <stdexcept>
#include <string>

#include "gpu/raster/hardware_draw.h"
#include "gpu/raster/tile_rasterizer.h"
#include "gpu/raster/triangle_buffers.h"
#include "shaders.h"

namespace parity::gpu {
namespace {

void check(const TriangleList& list, const Varyings& varyings, const char* who) {
  if (varyings.values.size() != list.clip_positions.size())
    throw std::invalid_argument(std::string(who) + ": there are " +
                                std::to_string(varyings.values.size()) + " varyings and " +
                                std::to_string(list.clip_positions.size()) + " clip positions");
}

Grid<vec4> grid_of(const TriangleList& list, const Buffer<vec4>& texels) {
  Grid<vec4> grid{list.width, list.height};
  grid.values() = texels.read();
  return grid;
}

std::size_t pixel_count(const TriangleList& list) {
  return std::size_t(list.width) * std::size_t(list.height);
}

}  // namespace

Grid<vec4> interpolate(Context& context, const TriangleList& list, const Varyings& varyings,
                       Snapping snapping) {
  check(list, varyings, "gpu::interpolate");
  const TriangleBuffers triangles(context, list, "gpu::interpolate");
  TileRasterizer rasterizer(context, {.width = list.width,
                                      .height = list.height,
                                      .samples = 1,
                                      .snapping = snapping,
                                      .depth = DepthMode::standard,
                                      .triangle_capacity = triangles.triangle_count()});
  const Buffer<vec4> values(context, varyings.values), texels(context, pixel_count(list));
  const Buffer<std::uint32_t> counts(context, pixel_count(list));
  const Kernel<InterpolateArgs> kernel(context, shaders::raster_interpolate_comp);
  do {
    context.run([&](Commands& commands) {
      rasterizer.record_coverage(commands, triangles.source(), counts);
    });
  } while (!rasterizer.fit(context));
  context.run([&](Commands& commands) {
    commands.dispatch(
        kernel, {std::uint32_t(texels.count())},
        {triangles.source(), values, rasterizer.elements(), texels, std::uint32_t(list.width),
         std::uint32_t(list.height), varyings.perspective ? 1u : 0u, 0});
  });
  return grid_of(list, texels);
}

Grid<vec4> hardware_interpolate(Context& context, const TriangleList& list,
                                const Varyings& varyings) {
  check(list, varyings, "gpu::hardware_interpolate");
  const TriangleBuffers triangles(context, list, "gpu::hardware_interpolate");
  const Buffer<vec4> values(context, varyings.values), texels(context, pixel_count(list));
  const Format format = Format::rgba32_float;
  const Image image(context, {.width = list.width, .height = list.height, .format = format});
  const RasterPipeline<DrawArgs> pipeline(context, shaders::raster_draw_vert,
                                          shaders::raster_draw_varying_frag,
                                          {.colors = {format},
                                           .blends = {},
                                           .depth = {},
                                           .culling = culling_of(list.cull),
                                           .specializations = {}});
  DrawArgs args = draw_args(triangles);
  args.varyings = values;
  args.perspective = varyings.perspective ? 1 : 0;
  context.run([&](Commands& commands) {
    commands.render({.colors = {cleared(image)}, .depth = {}},
                    [&](RenderPass& pass) { draw_triangles(pass, pipeline, triangles, args); });
    commands.copy(image, texels);
  });
  return grid_of(list, texels);
}

}  // namespace parity::gpu
