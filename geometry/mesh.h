#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/math.h"

namespace parity {

/// What an MTL file says of a material. Colours are linear RGB, as the numbers stand in the file.
struct MeshMaterial {
  std::string name;
  vec3 diffuse{0.8f};              ///< Kd
  vec3 specular{0.0f};             ///< Ks
  vec3 emission{0.0f};             ///< Ke
  float shininess = 0.0f;          ///< Ns, exponent of the highlight
  float opacity = 1.0f;            ///< d, or 1 - Tr
  std::optional<float> roughness;  ///< Pr, perceptual
  std::optional<float> metallic;   ///< Pm
  std::string diffuse_map;         ///< map_Kd, a file beside the mesh; empty: none
};

/// A polygon mesh as files hold it: shared vertices, faces of any number of corners, any topology.
/// Half-edge structure and measures are built from it on demand.
struct Mesh {
  std::vector<vec3> positions;         ///< m
  std::vector<std::uint32_t> corners;  ///< vertex of each corner, face after face
  std::vector<std::uint32_t> face_begin{
      0};  ///< face f has corners [face_begin[f], face_begin[f+1])

  /// Per corner; empty where the file has none.
  std::vector<vec2> corner_uvs;      ///< v up: (0, 0) is the lower left of the texture
  std::vector<vec3> corner_normals;  ///< unit, or 0 at a corner without one

  /// Per vertex; linear RGB, empty where the file has none.
  std::vector<vec3> vertex_colors;

  /// Per face; index into `materials`, -1 for none. Empty where the file has none.
  std::vector<int> face_materials;
  std::vector<MeshMaterial> materials;

  /// What the loader left out or mended, one sentence each.
  std::vector<std::string> notes;

  std::size_t vertex_count() const { return positions.size(); }
  std::size_t face_count() const { return face_begin.size() - 1; }
};

}  // namespace parity
