#include "gpu/transform/rotate.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "gpu/transform/element_map.h"
#include "shaders.h"
#include "shaders/transform/layout.h"

namespace parity::gpu {

std::vector<mat3> rotate(Context& context, std::span<const AxisAngle> rotations) {
  std::vector<vec4> inputs;
  inputs.reserve(rotations.size());
  for (const AxisAngle& rotation : rotations) {
    if (!(std::abs(rotation.angle) <= 8192.0f))
      throw std::invalid_argument("gpu::rotate: angle is " + std::to_string(rotation.angle) +
                                  ", must be within 8192 rad");
    inputs.emplace_back(rotation.axis, rotation.angle);
  }
  return element_map<RotateArgs, mat3>(context, shaders::transform_rotate_comp, inputs);
}

}  // namespace parity::gpu
