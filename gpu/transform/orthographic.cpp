#include "gpu/transform/orthographic.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "gpu/transform/element_map.h"
#include "gpu/transform/view_volume.h"
#include "shaders.h"

namespace parity::gpu {

std::vector<mat4> orthographic(Context& context, std::span<const ViewVolume> volumes,
                               DepthMode depth) {
  for (const ViewVolume& volume : volumes)
    if (!std::isfinite(volume.near) || !std::isfinite(volume.far) || volume.near == volume.far)
      throw std::invalid_argument("gpu::orthographic: near is " + std::to_string(volume.near) +
                                  ", far is " + std::to_string(volume.far) +
                                  ", must be finite and differ");
  return element_map<ProjectionArgs, mat4>(context, shaders::transform_orthographic_comp,
                                           volume_records(volumes, "gpu::orthographic"),
                                           std::uint32_t(depth));
}

}  // namespace parity::gpu
