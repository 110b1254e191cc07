#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/math.h"

namespace parity {

/// A polygon mesh as files hold it: shared vertices, faces of any number of corners, any topology.
/// Half-edge structure and measures are built from it on demand.
struct Mesh {
  std::vector<vec3> positions;         ///< m
  std::vector<std::uint32_t> corners;  ///< vertex of each corner, face after face
  std::vector<std::uint32_t> face_begin{
      0};  ///< face f has corners [face_begin[f], face_begin[f+1])

  /// Per corner; empty where the file has none.
  std::vector<vec2> corner_uvs;
  std::vector<vec3> corner_normals;

  /// Per vertex; linear RGB, empty where the file has none.
  std::vector<vec3> vertex_colors;

  /// Per face; index into `materials`, -1 for none. Empty where the file has none.
  std::vector<int> face_materials;
  std::vector<std::string> material_names;

  /// What the loader left out or mended, one sentence each.
  std::vector<std::string> notes;

  std::size_t vertex_count() const { return positions.size(); }
  std::size_t face_count() const { return face_begin.size() - 1; }
};

}  // namespace parity
