#include "gpu/raster/bresenham.h"

#include "gpu/raster/line_pixels.h"
#include "shaders.h"

namespace parity::gpu {

std::vector<std::vector<ivec2>> bresenham(Context& context, std::span<const Segment> segments) {
  return line_pixels(context, shaders::raster_bresenham_comp, segments, "gpu::bresenham");
}

}  // namespace parity::gpu
