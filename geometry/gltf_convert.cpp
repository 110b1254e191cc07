#include "geometry/gltf_convert.h"

#include <algorithm>
#include <cmath>

#include "geometry/gltf_primitive.h"
#include "geometry/input_error.h"

namespace parity::gltf {
namespace {

constexpr std::uint64_t base_budget = std::uint64_t(128) << 20;
constexpr std::uint64_t budget_per_byte = 64;
constexpr std::uint64_t node_bytes = 256;

bool is_finite(const dmat4& m) {
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      if (!std::isfinite(m[i][j])) return false;
  return true;
}

/// Nodes below the given roots, parents first.
std::vector<int> nodes_below(const Document& document, const std::vector<int>& roots) {
  std::vector<int> order = roots;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::vector<int>& children = document.nodes[std::size_t(order[i])].children;
    order.insert(order.end(), children.begin(), children.end());
  }
  return order;
}

std::vector<int> all_roots(const Document& document) {
  std::vector<int> roots;
  for (std::size_t i = 0; i < document.nodes.size(); ++i)
    if (document.nodes[i].parent < 0) roots.push_back(int(i));
  return roots;
}

class Converter {
 public:
  /// @param scene  holds the materials and their textures.
  Converter(const Document& document, const Data& data, const std::string& name, Scene scene)
      : conversion_{document,
                    data,
                    {},
                    name,
                    Budget(name, base_budget + budget_per_byte * data.input_size()),
                    Notes{}},
        mesh_of_(document.meshes.size(), -1),
        scene_(std::move(scene)) {
    conversion_.materials = scene_.materials;
  }

  Scene convert() {
    scene_.cameras = document().cameras;
    scene_.lights = document().lights;
    place_nodes();
    convert_nodes();
    check_meshes_not_shown();
    if (!document().animations.empty())
      conversion_.notes.add("animations ignored, the scene is loaded in its first pose",
                            document().animations.size());
    for (const std::string& note : conversion_.notes.sentences()) scene_.notes.push_back(note);
    return std::move(scene_);
  }

 private:
  const Document& document() const { return conversion_.document; }

  /// World matrices of all nodes, as joints may stand outside of the scene.
  void place_nodes() {
    world_.resize(document().nodes.size());
    for (const int node : nodes_below(document(), all_roots(document()))) {
      const Node& from = document().nodes[std::size_t(node)];
      dmat4& world = world_[std::size_t(node)];
      world = from.parent < 0 ? from.parent_from_node
                              : world_[std::size_t(from.parent)] * from.parent_from_node;
      if (!is_finite(world))
        throw InputError(conversion_.name, "nodes[" + std::to_string(node) +
                                               "]: its place in the world is not finite");
    }
  }

  void convert_nodes() {
    std::vector<int> roots = all_roots(document());
    if (document().scenes.empty()) {
      if (!document().nodes.empty()) conversion_.notes.add("no scene in the file, all nodes shown");
    } else {
      roots = document().scenes[std::size_t(std::max(document().scene, 0))];
    }
    const std::vector<int> order = nodes_below(document(), roots);
    std::vector<int> place(document().nodes.size(), -1);
    for (const int index : order) {
      const Node& from = document().nodes[std::size_t(index)];
      place[std::size_t(index)] = int(scene_.nodes.size());
      scene_.nodes.push_back({.name = from.name,
                              .parent = from.parent < 0 ? -1 : place[std::size_t(from.parent)],
                              .parent_from_node = from.parent_from_node,
                              .mesh = -1,
                              .camera = from.camera,
                              .light = from.light});
    }
    for (const int index : order)
      if (document().nodes[std::size_t(index)].mesh >= 0)
        place_mesh(std::size_t(index), place[std::size_t(index)]);
  }

  void place_mesh(std::size_t index, int place) {
    const Node& from = document().nodes[index];
    if (from.skin >= 0 && is_skinned(from.mesh)) {
      parity::Node skinned{.name = from.name};
      skinned.mesh = convert_mesh(from, skin_matrices(from.skin));
      scene_.nodes.push_back(skinned);
      return;
    }
    if (from.skin >= 0) conversion_.notes.add("nodes with a skin whose mesh has no joints");
    const int mesh = mesh_in_pose(from);
    if (from.instances.empty())
      scene_.nodes[std::size_t(place)].mesh = mesh;
    else
      place_instances(from, place, mesh);
  }

  bool is_skinned(int mesh) const {
    for (const Primitive& primitive : document().meshes[std::size_t(mesh)].primitives)
      if (primitive.attributes.contains("JOINTS_0") && primitive.attributes.contains("WEIGHTS_0"))
        return true;
    return false;
  }

  std::vector<dmat4> skin_matrices(int index) const {
    const Skin& skin = document().skins[std::size_t(index)];
    std::vector<mat4> inverse_bind;
    if (skin.inverse_bind_matrices >= 0)
      inverse_bind = conversion_.data.read<mat4>(skin.inverse_bind_matrices);
    std::vector<dmat4> matrices;
    for (std::size_t j = 0; j < skin.joints.size(); ++j) {
      const dmat4& world = world_[std::size_t(skin.joints[j])];
      matrices.push_back(inverse_bind.empty() ? world : world * dmat4(inverse_bind[j]));
      if (!is_finite(matrices.back()))
        throw InputError(conversion_.name, "skins[" + std::to_string(index) +
                                               "].inverseBindMatrices: matrix " +
                                               std::to_string(j) + " is not finite");
    }
    return matrices;
  }

  void check_meshes_not_shown() {
    for (std::size_t m = 0; m < mesh_of_.size(); ++m) {
      const std::vector<Primitive>& primitives = document().meshes[m].primitives;
      for (std::size_t p = 0; p < primitives.size() && mesh_of_[m] < 0; ++p) {
        const int indices = primitives[p].indices;
        if (indices >= 0)
          conversion_.budget.spend(4 * document().accessors[std::size_t(indices)].count, "meshes");
        check_indices(document(), conversion_.data, primitives[p], conversion_.name,
                      "meshes[" + std::to_string(m) + "].primitives[" + std::to_string(p) + "]");
      }
    }
  }

  /// The mesh as it stands without a skin; shared by the nodes that do not bend it on their own.
  int mesh_in_pose(const Node& from) {
    if (!from.weights.empty()) return convert_mesh(from, {});
    int& shared = mesh_of_[std::size_t(from.mesh)];
    if (shared < 0) shared = convert_mesh(from, {});
    return shared;
  }

  int convert_mesh(const Node& from, const std::vector<dmat4>& skin) {
    const Mesh& mesh = document().meshes[std::size_t(from.mesh)];
    const Pose pose{.weights = from.weights.empty() ? mesh.weights : from.weights,
                    .skin_matrices = skin};
    SceneMesh out{.name = mesh.name, .primitives = {}};
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
      if (!mesh.primitives[p].attributes.contains("POSITION")) {
        conversion_.notes.add("primitives without POSITION left out");
        continue;
      }
      const std::string place =
          "meshes[" + std::to_string(from.mesh) + "].primitives[" + std::to_string(p) + "]";
      out.primitives.push_back(convert_primitive(conversion_, mesh.primitives[p], place, pose));
      if (out.primitives.back().indices.empty()) out.primitives.pop_back();
    }
    scene_.meshes.push_back(std::move(out));
    return int(scene_.meshes.size()) - 1;
  }

  /// EXT_mesh_gpu_instancing: a child for every instance.
  void place_instances(const Node& from, int parent, int mesh) {
    std::vector<vec3> translations, scales;
    std::vector<vec4> rotations;
    const auto find = [&](const char* semantic) {
      const auto found = from.instances.find(semantic);
      return found == from.instances.end() ? -1 : found->second;
    };
    if (find("TRANSLATION") >= 0) translations = conversion_.data.read<vec3>(find("TRANSLATION"));
    if (find("SCALE") >= 0) scales = conversion_.data.read<vec3>(find("SCALE"));
    if (find("ROTATION") >= 0) rotations = conversion_.data.read<vec4>(find("ROTATION"));
    const std::size_t count = std::max({translations.size(), scales.size(), rotations.size()});
    conversion_.budget.spend(count * node_bytes, "EXT_mesh_gpu_instancing");
    for (std::size_t i = 0; i < count; ++i) {
      dmat4 matrix{1.0};
      if (!rotations.empty()) {
        const dvec4 r{rotations[i]};
        const double length = glm::length(r);
        if (length > 0) matrix = glm::mat4_cast(dquat(r.w, r.x, r.y, r.z) / length);
      }
      for (int c = 0; c < 3 && !scales.empty(); ++c) matrix[c] *= double(scales[i][c]);
      if (!translations.empty()) matrix[3] = dvec4(dvec3(translations[i]), 1);
      if (is_finite(matrix))
        scene_.nodes.push_back({.name = from.name,
                                .parent = parent,
                                .parent_from_node = matrix,
                                .mesh = mesh,
                                .camera = -1,
                                .light = -1});
      else
        conversion_.notes.add("instances left out because their place is not finite");
    }
  }

  Conversion conversion_;
  std::vector<int> mesh_of_;
  std::vector<dmat4> world_;
  Scene scene_;
};

}  // namespace

Scene convert_document(const Document& document, const Data& data, const Origin& origin) {
  Scene scene;
  scene.materials = document.materials;
  scene.notes = document.notes;
  convert_textures(document, data, origin, scene);
  return Converter(document, data, origin.name, std::move(scene)).convert();
}

}  // namespace parity::gltf
