#include "geometry/gltf_vertex_reader.h"

#include <numeric>

#include "geometry/input_error.h"

namespace parity::gltf {

VertexReader::VertexReader(Conversion& conversion, const Primitive& from, const std::string& place)
    : conversion_(conversion), from_(from), place_(place) {
  if (from.draco) decode_draco_mesh();
}

int VertexReader::components(const std::string& semantic) const {
  return accessor(from_.attributes.at(semantic)).components;
}

std::size_t VertexReader::total_vertex_count() const {
  return draco_ ? draco_->vertex_count
                : std::size_t(accessor(from_.attributes.at("POSITION")).count);
}

std::vector<std::uint32_t> VertexReader::indices() {
  std::vector<std::uint32_t> indices = stored_indices();
  const std::size_t count = total_vertex_count();
  for (std::size_t i = 0; i < indices.size(); ++i)
    if (indices[i] >= count)
      throw InputError(conversion_.name, place_ + ".indices: element " + std::to_string(i) +
                                             " is " + std::to_string(indices[i]) +
                                             ", but there are " + std::to_string(count) +
                                             " vertices");
  return indices;
}

std::vector<std::uint32_t> VertexReader::stored_indices() {
  if (draco_) return std::move(draco_->indices);
  if (from_.indices >= 0) {
    conversion_.budget.spend(4 * accessor(from_.indices).count, place_);
    return conversion_.data.read_unsigned(from_.indices);
  }
  conversion_.budget.spend(4 * total_vertex_count(), place_);
  std::vector<std::uint32_t> all(total_vertex_count());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

std::vector<uvec4> VertexReader::read_joints(const std::string& semantic) const {
  std::vector<uvec4> joints(vertex_count());
  if (draco_ && draco_->attributes.contains(semantic)) {
    const std::vector<vec4> values = read<vec4>(semantic, false);
    for (std::size_t i = 0; i < joints.size(); ++i)
      joints[i] = uvec4(glm::clamp(values[i], vec4(0), vec4(65535)));
    return joints;
  }
  const std::vector<std::uint32_t> values =
      conversion_.data.read_unsigned(from_.attributes.at(semantic), which_);
  for (std::size_t i = 0; i < joints.size(); ++i)
    joints[i] = {values[4 * i], values[4 * i + 1], values[4 * i + 2], values[4 * i + 3]};
  return joints;
}

std::vector<vec3> VertexReader::read_target(std::size_t target, const std::string& semantic) const {
  const auto found = from_.targets[target].find(semantic);
  if (found == from_.targets[target].end()) return {};
  spend_on_sparse(found->second);
  return conversion_.data.read<vec3>(found->second, which_);
}

void VertexReader::spend_on_sparse(int index) const {
  if (accessor(index).sparse) conversion_.budget.spend(4 * accessor(index).sparse->count, place_);
}

void VertexReader::decode_draco_mesh() {
  const std::string place = place_ + ".extensions.KHR_draco_mesh_compression";
  std::map<std::string, int> wanted;
  for (const auto& [semantic, index] : from_.attributes)
    wanted[semantic] = accessor(index).components;
  if (!from_.draco->attributes.contains("POSITION"))
    throw InputError(conversion_.name, place + ".attributes.POSITION is missing");
  draco_ = decode_draco(from_.draco->attributes, wanted, conversion_.data.view(from_.draco->view),
                        conversion_.name, place);
  const auto check_count = [&](int index) {
    if (accessor(index).count != draco_->vertex_count)
      throw InputError(conversion_.name, place + ": the mesh has " +
                                             std::to_string(draco_->vertex_count) +
                                             " vertices, accessors[" + std::to_string(index) +
                                             "] has " + std::to_string(accessor(index).count));
  };
  for (const auto& [semantic, index] : from_.attributes)
    if (!draco_->attributes.contains(semantic)) check_count(index);
  for (const Attributes& target : from_.targets)
    for (const auto& [semantic, index] : target) check_count(index);
  conversion_.budget.spend(std::uint64_t(draco_->vertex_count) * 64 + draco_->indices.size() * 4,
                           place);
}

}  // namespace parity::gltf
