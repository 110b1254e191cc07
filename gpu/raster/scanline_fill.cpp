#include "gpu/raster/scanline_fill.h"

#include <algorithm>

#include "geometry/camera.h"
#include "gpu/core/commands.h"
#include "gpu/raster/raster_target.h"
#include "gpu/raster/triangle_buffers.h"
#include "gpu/raster/triangle_pieces.h"
#include "shaders.h"

namespace parity::gpu {

Coverage scanline_fill(Context& context, const TriangleList& list, Snapping snapping) {
  const TriangleBuffers triangles(context, list, "gpu::scanline_fill");
  const RasterTarget target = raster_target(list.width, list.height, list.samples, snapping);
  const std::size_t samples =
      std::size_t(list.width) * std::size_t(list.height) * std::size_t(list.samples);
  const Buffer<std::uint32_t> counts(context, samples), elements(context, samples);
  const Kernel<ScanlineArgs> kernel(context, shaders::raster_scanline_fill_comp);
  TrianglePieces pieces(context, target, std::uint32_t(DepthMode::standard),
                        triangles.triangle_count());
  do {
    context.run([&](Commands& commands) { pieces.record(commands, triangles.source()); });
  } while (!pieces.fit(context));
  const std::uint32_t piece_count = pieces.count().read()[0];
  // Some devices cut the loops of a thread at 65,535 turns: few pieces a dispatch.
  const std::uint32_t step = std::max(1u, 50000u / (target.width + 16));
  context.run([&](Commands& commands) {
    commands.fill(counts, 0);
    commands.fill(elements, 0);
    for (std::uint32_t first = 0; first < piece_count; first += step)
      commands.dispatch(
          kernel, {target.height * target.samples},
          {target, pieces.pieces(), counts, elements, first, std::min(first + step, piece_count)});
  });
  return {list.width, list.height, list.samples, counts.read(), elements.read()};
}

}  // namespace parity::gpu
