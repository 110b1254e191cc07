#include "gpu/raster/dda_line.h"

#include "gpu/raster/line_pixels.h"
#include "shaders.h"

namespace parity::gpu {

std::vector<std::vector<ivec2>> dda_line(Context& context, std::span<const Segment> segments) {
  return line_pixels(context, shaders::raster_dda_line_comp, segments, "gpu::dda_line");
}

}  // namespace parity::gpu
