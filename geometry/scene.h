#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/camera.h"
#include "geometry/grid.h"
#include "geometry/light.h"
#include "geometry/material.h"
#include "geometry/math.h"

namespace parity {

enum class Topology { points, lines, triangles };

/// What one material covers. Strips, loops and fans are already expanded; `indices` holds 1, 2 or 3
/// vertices an element and each is < positions.size() (validated by the loader).
struct Primitive {
  Topology topology = Topology::triangles;
  int material = -1;  ///< index into Scene::materials, -1: the default material
  std::vector<std::uint32_t> indices;

  std::vector<vec3> positions;         ///< m, finite
  std::vector<vec3> normals;           ///< unit; always there for triangles
  std::vector<vec4> tangents;          ///< unit xyz, w = +-1; there if the material maps normals
  std::vector<std::vector<vec2>> uvs;  ///< by TEXCOORD_n; each empty or one a vertex
  std::vector<vec4> colors;            ///< COLOR_0, linear RGBA; empty: white
};

/// Primitives that are placed together.
struct SceneMesh {
  std::string name;
  std::vector<Primitive> primitives;
};

/// A node of the hierarchy. Parents come before children in Scene::nodes (the loader sorts).
struct Node {
  std::string name;
  int parent = -1;
  dmat4 parent_from_node{1.0};
  int mesh = -1;
  int camera = -1;
  int light = -1;
};

/// The border is 0; mirror_clamp_to_edge mirrors once.
enum class Wrap { repeat, mirrored_repeat, clamp_to_edge, clamp_to_border, mirror_clamp_to_edge };
enum class Filter { nearest, linear };

/// What the program gives to textures: files do not say how anisotropic a sampler is.
constexpr int default_max_anisotropy = 8;

struct Sampler {
  Wrap wrap_u = Wrap::repeat;
  Wrap wrap_v = Wrap::repeat;
  Filter mag = Filter::linear;
  Filter min = Filter::linear;
  std::optional<Filter> mip = Filter::linear;  ///< none: level 0 only
  int max_anisotropy = 1;  ///< 1 to 16: how long a footprint is followed; if all filters are linear
};

struct Texture {
  int image = 0;
  Sampler sampler;
};

/// glTF 2.0 as plain values, checked: every index is in range, every number finite, no cycles.
/// Skins and morph targets are applied at load in the pose that the file starts with.
struct Scene {
  std::vector<Node> nodes;
  std::vector<SceneMesh> meshes;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<Grid<u8vec4>> images;  ///< as stored (not decoded from sRGB), row 0 on top
  std::vector<Camera> cameras;
  std::vector<Light> lights;

  /// What was ignored, mended or left out, one sentence each.
  std::vector<std::string> notes;
};

/// World from node, one a node: the product along the path from the root.
///
/// @param scene  nodes sorted parents first.
std::vector<dmat4> world_from_nodes(const Scene& scene);

/// The box around all placed vertices in world space.
struct Bounds {
  dvec3 min{0.0};
  dvec3 max{0.0};
  bool empty = true;
};
Bounds world_bounds(const Scene& scene);

}  // namespace parity
