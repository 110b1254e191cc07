#pragma once

#include <span>
#include <string>
#include <vector>

#include "geometry/gltf_data.h"
#include "geometry/gltf_document.h"
#include "geometry/gltf_topology.h"

namespace parity::gltf {

/// The shape in which a mesh is frozen. Empty spans: as modelled.
struct Pose {
  std::span<const double> weights;       ///< one a morph target
  std::span<const dmat4> skin_matrices;  ///< world from mesh, one a joint
};

/// Bytes that a load may still take, so that a small file cannot fill the memory.
class Budget {
 public:
  Budget(std::string name, std::uint64_t bytes) : name_(std::move(name)), left_(bytes) {}
  /// @throws InputError  the budget is spent.
  void spend(std::uint64_t bytes, const std::string& place);

 private:
  std::string name_;
  std::uint64_t left_ = 0;
};

/// Checks that attributes, indices and morph targets have types that the specification allows and
/// agree in number.
///
/// @throws InputError  naming meshes[i].primitives[j].
void check_primitive(const Document& document, const Primitive& primitive, const std::string& name,
                     const std::string& place);

/// Checks that every index names a vertex.
///
/// @throws InputError  naming meshes[i].primitives[j].indices.
void check_indices(const Document& document, const Data& data, const Primitive& primitive,
                   const std::string& name, const std::string& place);

/// What the conversion of all primitives has in common.
struct Conversion {
  const Document& document;
  const Data& data;
  std::span<const Material> materials;  ///< with the textures that the scene keeps
  std::string name;
  Budget budget;
  Notes notes;
};

/// Indices expanded, unused vertices left out, posed, with normals. Texture coordinates are read
/// for the sets that the material uses; tangents if it maps normals.
///
/// @throws InputError  an index or joint out of range.
parity::Primitive convert_primitive(Conversion& conversion, const Primitive& from,
                                    const std::string& place, const Pose& pose);

}  // namespace parity::gltf
