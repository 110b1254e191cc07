#include "gpu/transform/quaternion.h"

#include <stdexcept>
#include <string>

#include "gpu/transform/element_map.h"
#include "shaders.h"
#include "shaders/transform/layout.h"

namespace parity::gpu {
namespace {

std::vector<vec4> components(std::span<const quat> quaternions) {
  std::vector<vec4> records;
  records.reserve(quaternions.size());
  for (const quat& q : quaternions) records.push_back(quaternion_components(q));
  return records;
}

}  // namespace

vec4 quaternion_components(const quat& q) { return {q.x, q.y, q.z, q.w}; }

std::vector<mat3> quaternion_matrix(Context& context, std::span<const quat> quaternions) {
  return element_map<QuaternionMatrixArgs, mat3>(context, shaders::transform_quaternion_matrix_comp,
                                                 components(quaternions));
}

std::vector<vec3> quaternion_rotate(Context& context, std::span<const quat> quaternions,
                                    std::span<const vec3> vectors) {
  if (quaternions.size() != vectors.size())
    throw std::invalid_argument("gpu::quaternion_rotate: there are " +
                                std::to_string(quaternions.size()) + " quaternions and " +
                                std::to_string(vectors.size()) + " vectors");
  const Buffer<vec4> quaternion_buffer(context, components(quaternions));
  const Buffer<vec3> vector_buffer(context, vectors), results(context, vectors.size());
  const Kernel<QuaternionRotateArgs> kernel(context, shaders::transform_quaternion_rotate_comp);
  const auto count = std::uint32_t(vectors.size());
  context.run([&](Commands& commands) {
    commands.dispatch(kernel, {count}, {quaternion_buffer, vector_buffer, results, count, 0});
  });
  return results.read();
}

}  // namespace parity::gpu
