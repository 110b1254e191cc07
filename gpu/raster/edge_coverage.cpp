#include "gpu/raster/edge_coverage.h"

#include "gpu/raster/hardware_draw.h"
#include "gpu/raster/tile_rasterizer.h"
#include "gpu/raster/triangle_buffers.h"
#include "shaders.h"

namespace parity::gpu {
namespace {

TileRasterizerOptions options_of(const TriangleList& list, Snapping snapping) {
  return {.width = list.width,
          .height = list.height,
          .samples = list.samples,
          .snapping = snapping,
          .depth = DepthMode::standard,
          .triangle_capacity = std::uint32_t(list.triangles.size())};
}

ImageOptions target_options(const TriangleList& list, Format format) {
  return {.width = list.width,
          .height = list.height,
          .levels = 1,
          .samples = list.samples,
          .format = format};
}

/// Copies both targets of a coverage draw, sample by sample.
class SampleReader {
 public:
  explicit SampleReader(Context& context)
      : fetch_(context, shaders::raster_fetch_samples_comp),
        sampler_(context, {.linear_mag = false, .linear_min = false, .linear_mip = false}) {}

  void record(Commands& commands, const Image& count_image, const Image& element_image,
              const Buffer<float>& counts, const Buffer<std::uint32_t>& elements) const {
    const ImageOptions& size = count_image.options();
    if (size.samples == 1) {
      commands.copy(count_image, counts);
      commands.copy(element_image, elements);
      return;
    }
    const ImageBinding images[] = {{&count_image, &sampler_}, {&element_image, &sampler_}};
    const auto width = std::uint32_t(size.width), height = std::uint32_t(size.height);
    commands.dispatch(fetch_, {width, height},
                      {counts, elements, width, height, std::uint32_t(size.samples), 0}, images);
  }

 private:
  Kernel<FetchSamplesArgs> fetch_;
  ImageSampler sampler_;
};

}  // namespace

Coverage edge_coverage(Context& context, const TriangleList& list, Snapping snapping) {
  const TriangleBuffers triangles(context, list, "gpu::edge_coverage");
  TileRasterizer rasterizer(context, options_of(list, snapping));
  const Buffer<std::uint32_t> counts(context, rasterizer.elements().count());
  do {
    context.run([&](Commands& commands) {
      rasterizer.record_coverage(commands, triangles.source(), counts);
    });
  } while (!rasterizer.fit(context));
  return {list.width, list.height, list.samples, counts.read(), rasterizer.elements().read()};
}

Coverage hardware_coverage(Context& context, const TriangleList& list) {
  const TriangleBuffers triangles(context, list, "gpu::hardware_coverage");
  const RasterPipeline<DrawArgs> pipeline(context, shaders::raster_draw_vert,
                                          shaders::raster_draw_coverage_frag,
                                          {.colors = {Format::r32_float, Format::r32_uint},
                                           .blends = {Blend::add, Blend::replace},
                                           .depth = {},
                                           .culling = culling_of(list.cull),
                                           .samples = list.samples,
                                           .specializations = {}});
  const Image count_image(context, target_options(list, Format::r32_float));
  const Image element_image(context, target_options(list, Format::r32_uint));
  const std::size_t samples =
      std::size_t(list.width) * std::size_t(list.height) * std::size_t(list.samples);
  const Buffer<float> counts(context, samples);
  const Buffer<std::uint32_t> elements(context, samples);
  const SampleReader reader(context);
  context.run([&](Commands& commands) {
    commands.render(
        {.colors = {cleared(count_image), cleared(element_image)}, .depth = {}},
        [&](RenderPass& pass) { draw_triangles(pass, pipeline, triangles, draw_args(triangles)); });
    reader.record(commands, count_image, element_image, counts, elements);
  });
  const std::vector<float> sums = counts.read();
  return {list.width, list.height, list.samples, {sums.begin(), sums.end()}, elements.read()};
}

}  // namespace parity::gpu
