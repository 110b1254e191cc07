#include "gpu/raster/raster_target.h"

#include <algorithm>

namespace parity::gpu {

RasterTarget raster_target(int width, int height, int samples, Snapping snapping) {
  return {.width = std::uint32_t(width),
          .height = std::uint32_t(height),
          .samples = std::uint32_t(samples),
          .snapping = std::uint32_t(snapping),
          .guard_band = 32766.0f / float(std::max(width, height)),
          .tiles_x = (std::uint32_t(width) + tile_side - 1) / tile_side};
}

}  // namespace parity::gpu
