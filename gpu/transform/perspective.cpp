#include "gpu/transform/perspective.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "gpu/transform/element_map.h"
#include "gpu/transform/view_volume.h"
#include "shaders.h"

namespace parity::gpu {

std::vector<mat4> perspective(Context& context, std::span<const ViewVolume> volumes,
                              DepthMode depth) {
  for (const ViewVolume& volume : volumes)
    if (!(volume.near > 0 && volume.far > volume.near && std::isfinite(volume.near)))
      throw std::invalid_argument("gpu::perspective: near is " + std::to_string(volume.near) +
                                  ", far is " + std::to_string(volume.far) +
                                  ", must be 0 < near < far");
  return element_map<ProjectionArgs, mat4>(context, shaders::transform_perspective_comp,
                                           volume_records(volumes, "gpu::perspective"),
                                           std::uint32_t(depth));
}

}  // namespace parity::gpu
