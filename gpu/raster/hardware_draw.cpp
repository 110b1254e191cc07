#include "gpu/raster/hardware_draw.h"

#include <array>

namespace parity::gpu {

Culling culling_of(Cull cull) {
  switch (cull) {
    case Cull::back:
      return Culling::back;
    case Cull::front:
      return Culling::front;
    default:
      return Culling::none;
  }
}

ColorTarget cleared(const Image& image) {
  return {.image = &image, .clear = std::array<float, 4>{0, 0, 0, 0}, .resolve = nullptr};
}

DrawArgs draw_args(const TriangleBuffers& triangles) {
  const TriangleSource source = triangles.source();
  return {.clip_positions = source.clip_positions,
          .triangles = source.triangles,
          .varyings = source.clip_positions,
          .perspective = 1,
          .first_element = source.first_element,
          .log_scale = 0,
          .log_near = 0};
}

void draw_triangles(RenderPass& pass, const RasterPipeline<DrawArgs>& pipeline,
                    const TriangleBuffers& triangles, const DrawArgs& args) {
  if (triangles.triangle_count() > 0) pass.draw(pipeline, args, 3 * triangles.triangle_count());
}

}  // namespace parity::gpu
