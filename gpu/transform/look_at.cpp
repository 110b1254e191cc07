#include "gpu/transform/look_at.h"

#include <stdexcept>
#include <string>

#include "gpu/transform/element_map.h"
#include "shaders.h"
#include "shaders/transform/layout.h"

namespace parity::gpu {

std::vector<mat4> look_at(Context& context, std::span<const LookAt> cameras) {
  std::vector<LookAtRecord> records;
  records.reserve(cameras.size());
  for (const LookAt& camera : cameras) {
    const dvec3 right = glm::cross(dvec3(camera.center) - dvec3(camera.eye), dvec3(camera.up));
    if (!(glm::dot(right, right) > 0))
      throw std::invalid_argument("gpu::look_at: camera " + std::to_string(records.size()) +
                                  " looks along its up vector, or nowhere");
    records.push_back({camera.eye, camera.center, camera.up});
  }
  return element_map<LookAtArgs, mat4>(context, shaders::transform_look_at_comp, records);
}

}  // namespace parity::gpu
