#include "geometry/scene_from_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "geometry/gltf_files.h"
#include "geometry/gltf_topology.h"
#include "geometry/image_io.h"
#include "geometry/input_error.h"
#include "geometry/mesh_triangulate.h"

namespace parity {
namespace {

constexpr std::uint64_t largest_image_file = std::uint64_t(1) << 30;
constexpr double crease_cosine = 0.5;
constexpr std::uint32_t most_around = 256;  ///< of a vertex are compared, so that work stays linear

/// A mesh cut into triangles, and the area vector of each (half the cross product, up to a factor).
struct Cut {
  std::vector<CornerTriangle> triangles;
  std::vector<int> materials;
  std::vector<dvec3> areas;
};

dvec3 unit(const dvec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : dvec3(0.0);
}

Cut cut(const Mesh& mesh) {
  Cut out{.triangles = triangulate(mesh), .materials = {}, .areas = {}};
  const auto position = [&](std::uint32_t corner) {
    return dvec3(mesh.positions[mesh.corners[corner]]);
  };
  std::size_t face = 0;
  for (const CornerTriangle& t : out.triangles) {
    while (mesh.face_begin[face + 1] <= t[0]) ++face;
    out.materials.push_back(mesh.face_materials.empty() ? -1 : mesh.face_materials[face]);
    out.areas.push_back(
        glm::cross(position(t[1]) - position(t[0]), position(t[2]) - position(t[0])));
  }
  return out;
}

/// Triangles at each vertex: those of vertex v stand at [begin[v], begin[v + 1]).
struct Incidence {
  std::vector<std::uint32_t> begin;
  std::vector<std::uint32_t> triangles;
};

Incidence find_incidence(const Mesh& mesh, const Cut& cut) {
  Incidence out;
  out.begin.assign(mesh.positions.size() + 1, 0);
  for (const CornerTriangle& t : cut.triangles)
    for (const std::uint32_t corner : t) ++out.begin[mesh.corners[corner] + 1];
  std::partial_sum(out.begin.begin(), out.begin.end(), out.begin.begin());
  out.triangles.resize(3 * cut.triangles.size());
  std::vector<std::uint32_t> next(out.begin.begin(), out.begin.end() - 1);
  for (std::size_t t = 0; t < cut.triangles.size(); ++t)
    for (const std::uint32_t corner : cut.triangles[t])
      out.triangles[next[mesh.corners[corner]]++] = std::uint32_t(t);
  return out;
}

/// Normals of the three corners of each triangle. A vertex with very many triangles keeps theirs
/// flat, so that the work stays linear.
std::vector<vec3> corner_normals(const Mesh& mesh, const Cut& cut) {
  const Incidence around = find_incidence(mesh, cut);
  std::vector<vec3> normals;
  normals.reserve(3 * cut.triangles.size());
  std::vector<dvec3> directions;
  directions.reserve(cut.areas.size());
  for (const dvec3& area : cut.areas) directions.push_back(unit(area));
  for (std::size_t t = 0; t < cut.triangles.size(); ++t)
    for (const std::uint32_t corner : cut.triangles[t]) {
      const vec3 given = mesh.corner_normals.empty() ? vec3(0) : mesh.corner_normals[corner];
      const std::uint32_t v = mesh.corners[corner];
      dvec3 sum = given == vec3(0) ? cut.areas[t] : dvec3(given);
      if (given == vec3(0) && around.begin[v + 1] - around.begin[v] <= most_around) {
        sum = dvec3(0.0);
        for (std::uint32_t i = around.begin[v]; i < around.begin[v + 1]; ++i) {
          const std::uint32_t other = around.triangles[i];
          if (other == t || glm::dot(directions[t], directions[other]) > crease_cosine)
            sum += cut.areas[other];
        }
      }
      normals.emplace_back(unit(sum));
    }
  return normals;
}

/// Emits corners as vertices of primitives, equal ones once.
class VertexPool {
 public:
  explicit VertexPool(const Mesh& mesh) : mesh_(mesh), newest_(mesh.positions.size()) {}

  /// Starts another primitive.
  void begin() { ++current_; }

  void add(std::uint32_t corner, const vec3& normal, Primitive& out) {
    const std::uint32_t vertex = mesh_.corners[corner];
    const vec2 uv = mesh_.corner_uvs.empty()
                        ? vec2(0)
                        : vec2(mesh_.corner_uvs[corner].x, 1 - mesh_.corner_uvs[corner].y);
    if (out.positions.empty()) start(out);
    Emitted& newest = newest_[vertex];
    if (newest.primitive != current_) newest = {current_, none};
    std::uint32_t index = newest.index;
    for (std::uint32_t tried = 0; index != none && tried < most_around; ++tried) {
      if (out.normals[index] == normal && (out.uvs.empty() || out.uvs[0][index] == uv)) {
        out.indices.push_back(index);
        return;
      }
      index = older_[index];
    }
    emit(vertex, normal, uv, newest, out);
  }

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFFu;

  /// The newest of the vertices made of one vertex of the mesh, in one primitive.
  struct Emitted {
    std::uint32_t primitive = 0;
    std::uint32_t index = none;
  };

  void start(Primitive& out) {
    older_.clear();
    if (!mesh_.corner_uvs.empty()) out.uvs.resize(1);
  }

  void emit(std::uint32_t vertex, const vec3& normal, const vec2& uv, Emitted& newest,
            Primitive& out) {
    const std::uint32_t index = std::uint32_t(out.positions.size());
    older_.push_back(newest.index);
    newest.index = index;
    out.indices.push_back(index);
    out.positions.push_back(mesh_.positions[vertex]);
    out.normals.push_back(normal);
    if (!out.uvs.empty()) out.uvs[0].push_back(uv);
    if (!mesh_.vertex_colors.empty()) out.colors.emplace_back(mesh_.vertex_colors[vertex], 1.0f);
  }

  const Mesh& mesh_;
  std::vector<Emitted> newest_;
  std::vector<std::uint32_t> older_;  ///< by vertex of the primitive: the one made before it
  std::uint32_t current_ = 0;
};

Material default_material() {
  Material material;
  material.base_color = vec4(0.8f, 0.8f, 0.8f, 1.0f);
  material.metallic = 0;
  material.roughness = 0.5f;
  material.double_sided = true;
  return material;
}

Material convert_material(const MeshMaterial& from) {
  const auto unit_range = [](float value) { return std::clamp(value, 0.0f, 1.0f); };
  Material material = default_material();
  material.name = from.name;
  material.base_color = vec4(glm::clamp(from.diffuse, vec3(0), vec3(1)), unit_range(from.opacity));
  material.emission = glm::max(from.emission, vec3(0));
  material.metallic = unit_range(from.metallic.value_or(0));
  const float alpha = std::sqrt(2 / (std::max(from.shininess, 0.0f) + 2));
  material.roughness = unit_range(from.roughness.value_or(std::sqrt(alpha)));
  if (material.base_color.w < 1) material.alpha_mode = AlphaMode::blend;
  return material;
}

/// Textures of the materials, each file once.
void load_maps(const Mesh& mesh, const gltf::Origin& origin, Scene& scene) {
  std::map<std::string, int> loaded;
  for (std::size_t m = 0; m < mesh.materials.size(); ++m) {
    const std::string& map = mesh.materials[m].diffuse_map;
    if (map.empty() || mesh.corner_uvs.empty()) continue;
    const auto [entry, is_new] = loaded.try_emplace(map, -1);
    if (is_new) try {
        const gltf::Bytes bytes = gltf::read_uri(map, origin, "map_Kd", largest_image_file);
        scene.images.push_back(decode_image(bytes, origin.name + ": map_Kd"));
        scene.textures.push_back({.image = int(scene.images.size()) - 1, .sampler = {}});
        entry->second = int(scene.textures.size()) - 1;
      } catch (const InputError& error) {
        scene.notes.push_back(std::string(error.what()) + ": left out");
      }
    scene.materials[m].base_color_texture.texture = entry->second;
  }
}

}  // namespace

Scene scene_from_mesh(const Mesh& mesh, const std::string& name,
                      const std::optional<std::filesystem::path>& folder) {
  const Cut cut_mesh = cut(mesh);
  const std::vector<vec3> normals = corner_normals(mesh, cut_mesh);
  Scene scene;
  scene.notes = mesh.notes;
  for (const MeshMaterial& material : mesh.materials)
    scene.materials.push_back(convert_material(material));
  load_maps(mesh, {.name = name, .folder = folder}, scene);
  const int otherwise = int(scene.materials.size());
  scene.materials.push_back(default_material());

  std::vector<std::uint32_t> order(cut_mesh.triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t t) { return cut_mesh.materials[t]; });
  gltf::Notes notes;
  VertexPool pool(mesh);
  SceneMesh out{.name = std::filesystem::path(name).stem().string(), .primitives = {}};
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    const int material = cut_mesh.materials[order[begin]];
    Primitive primitive{.material = material < 0 ? otherwise : material};
    pool.begin();
    for (; end < order.size() && cut_mesh.materials[order[end]] == material; ++end)
      for (std::size_t c = 0; c < 3; ++c)
        pool.add(cut_mesh.triangles[order[end]][c], normals[3 * order[end] + c], primitive);
    gltf::drop_unusable(primitive, notes);
    if (!primitive.indices.empty()) out.primitives.push_back(std::move(primitive));
  }
  Node node{.name = out.name};
  scene.meshes.push_back(std::move(out));
  node.mesh = 0;
  scene.nodes.push_back(node);
  for (const std::string& note : notes.sentences()) scene.notes.push_back(note);
  return scene;
}

}  // namespace parity
