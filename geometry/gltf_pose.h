#pragma once

#include "geometry/gltf_vertex_reader.h"

namespace parity::gltf {

/// Adds the morph targets of a pose to positions, normals and tangents.
void apply_morph(const VertexReader& reader, std::span<const double> weights,
                 parity::Primitive& primitive);

/// Carries positions, normals and tangents to the world by the weighted matrices of their joints.
/// Weights that do not sum to 1 are scaled; a vertex without weight follows the first joint.
///
/// @param skin_matrices  world from mesh, one a joint.
/// @param place          of the primitive, for messages.
/// @throws InputError  a joint that the skin does not have.
///
/// Source: glTF 2.0, 3.7.3 "Skins".
void apply_skin(const VertexReader& reader, std::span<const dmat4> skin_matrices,
                const std::string& place, Conversion& conversion, parity::Primitive& primitive);

/// Unit normals: those of the file where they have a direction, of the faces where not; flat ones
/// if the file has none.
void finish_normals(parity::Primitive& primitive, Notes& notes);

/// Unit tangents with w = +-1, of what the file says.
void normalize_tangents(parity::Primitive& primitive, Notes& notes);

}  // namespace parity::gltf
