#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/gltf_compression.h"
#include "geometry/gltf_primitive.h"

namespace parity::gltf {

/// Reads the attributes of one primitive, from its accessors or from its Draco mesh, for the
/// vertices that are drawn.
class VertexReader {
 public:
  /// @throws InputError  the Draco mesh is damaged or does not fit the accessors.
  VertexReader(Conversion& conversion, const Primitive& from, const std::string& place);

  bool has(const std::string& semantic) const { return from_.attributes.contains(semantic); }
  int components(const std::string& semantic) const;
  std::size_t total_vertex_count() const;

  /// To be called once.
  /// @throws InputError  an index past the last vertex.
  std::vector<std::uint32_t> indices();

  /// From here on only these vertices; empty: all.
  void select(std::vector<std::uint32_t> which) { which_ = std::move(which); }
  std::size_t vertex_count() const { return which_.empty() ? total_vertex_count() : which_.size(); }

  /// One value a selected vertex; empty if there is no such attribute.
  template <typename Vector>
  std::vector<Vector> read(const std::string& semantic, bool force_normalized) const;
  std::vector<uvec4> read_joints(const std::string& semantic) const;

  /// What a morph target adds; empty if it leaves this attribute alone.
  std::vector<vec3> read_target(std::size_t target, const std::string& semantic) const;

 private:
  const Accessor& accessor(int index) const {
    return conversion_.document.accessors[std::size_t(index)];
  }
  std::vector<std::uint32_t> stored_indices();
  void decode_draco_mesh();
  /// Sparse elements are walked through however few vertices are selected.
  void spend_on_sparse(int accessor) const;

  Conversion& conversion_;
  const Primitive& from_;
  const std::string& place_;
  std::optional<DracoMesh> draco_;
  std::vector<std::uint32_t> which_;
};

template <typename Vector>
std::vector<Vector> VertexReader::read(const std::string& semantic, bool force_normalized) const {
  if (!has(semantic)) return {};
  if (!draco_ || !draco_->attributes.contains(semantic)) {
    spend_on_sparse(from_.attributes.at(semantic));
    return conversion_.data.read<Vector>(from_.attributes.at(semantic), which_, force_normalized);
  }
  const std::vector<float>& values = draco_->attributes.at(semantic);
  constexpr std::size_t length = std::size_t(Vector::length());
  std::vector<Vector> vectors(vertex_count());
  for (std::size_t i = 0; i < vectors.size(); ++i)
    for (std::size_t c = 0; c < length; ++c)
      vectors[i][int(c)] = values[(which_.empty() ? i : which_[i]) * length + c];
  return vectors;
}

}  // namespace parity::gltf
