#include "geometry/gltf_primitive.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/gltf_pose.h"
#include "geometry/gltf_vertex_reader.h"
#include "geometry/input_error.h"
#include "geometry/tangent_space.h"

namespace parity::gltf {
namespace {

// Position, normal, tangent, colour, a pair of texture coordinates, and room for splitting.
constexpr std::uint64_t vertex_bytes = 64;

class Builder {
 public:
  Builder(Conversion& conversion, const Primitive& from, const std::string& place, const Pose& pose)
      : conversion_(conversion),
        from_(from),
        place_(place),
        pose_(pose),
        reader_(conversion, from, place) {
    out_.topology = topology_of(from.mode);
    out_.material = from.material;
  }

  parity::Primitive build() {
    read_indices();
    if (out_.indices.empty()) return std::move(out_);
    conversion_.budget.spend(std::uint64_t(reader_.vertex_count()) * vertex_bytes, place_);
    read_vertices();
    apply_morph(reader_, pose_.weights, out_);
    if (!pose_.skin_matrices.empty())
      apply_skin(reader_, pose_.skin_matrices, place_, conversion_, out_);
    drop_unusable(out_, conversion_.notes);
    if (out_.indices.empty()) return std::move(out_);
    finish();
    return std::move(out_);
  }

 private:
  const Material* material() const {
    return from_.material < 0 ? nullptr : &conversion_.materials[std::size_t(from_.material)];
  }

  bool wants_tangents() const {
    return out_.topology == Topology::triangles && material() && needs_tangents(*material());
  }

  void read_indices() {
    std::vector<std::uint32_t> indices = reader_.indices();
    const int mode = from_.draco ? 4 : from_.mode;
    if (mode != 0 && mode != 1 && mode != 4)
      conversion_.budget.spend(12 * std::uint64_t(indices.size()), place_);
    out_.indices = expand(mode, std::move(indices), conversion_.notes);
    if (!out_.indices.empty()) reader_.select(compact(out_.indices, reader_.total_vertex_count()));
  }

  void read_vertices() {
    out_.positions = reader_.read<vec3>("POSITION", false);
    check_declared_box();
    out_.normals = reader_.read<vec3>("NORMAL", true);
    if (wants_tangents() && !out_.normals.empty())
      out_.tangents = reader_.read<vec4>("TANGENT", true);
    read_uvs();
    read_colors();
  }

  /// min and max are advice: they are compared, never used.
  void check_declared_box() {
    const Accessor& a =
        conversion_.document.accessors[std::size_t(from_.attributes.at("POSITION"))];
    if (a.min.size() != 3 || a.max.size() != 3 || a.normalized) return;
    const dvec3 low{a.min[0], a.min[1], a.min[2]}, high{a.max[0], a.max[1], a.max[2]};
    const dvec3 slack = 1e-5 * glm::max(glm::abs(low), glm::abs(high));  // of a short decimal print
    const bool holds = std::ranges::none_of(out_.positions, [&](const vec3& p) {
      return glm::any(glm::lessThan(dvec3(p), low - slack)) ||
             glm::any(glm::greaterThan(dvec3(p), high + slack));
    });
    if (!holds) conversion_.notes.add("POSITION accessors whose min and max do not hold");
  }

  void read_uvs() {
    if (!material()) return;
    const Material& m = *material();
    for (const TextureUse* use : parity::textures_of(m)) {
      if (use->texture < 0 && !(wants_tangents() && use == &tangent_texture(m))) continue;
      const std::size_t set = std::size_t(use->uv_set);
      if (out_.uvs.size() <= set) out_.uvs.resize(set + 1);
      if (!out_.uvs[set].empty()) continue;
      const std::string semantic = "TEXCOORD_" + std::to_string(set);
      out_.uvs[set] = reader_.read<vec2>(semantic, false);
      if (reader_.has(semantic)) continue;
      out_.uvs[set].assign(out_.positions.size(), vec2(0));
      conversion_.notes.add("primitives without the texture coordinates of their material");
    }
  }

  void read_colors() {
    if (!reader_.has("COLOR_0")) return;
    if (reader_.components("COLOR_0") == 4) {
      out_.colors = reader_.read<vec4>("COLOR_0", true);
      return;
    }
    for (const vec3& color : reader_.read<vec3>("COLOR_0", true))
      out_.colors.emplace_back(color, 1.0f);
  }

  void finish() {
    if (out_.topology == Topology::triangles) finish_normals(out_, conversion_.notes);
    mend_uvs_and_colors();
    if (!wants_tangents()) return;
    if (!out_.tangents.empty()) return normalize_tangents(out_, conversion_.notes);
    const TextureUse& use = tangent_texture(*material());
    std::vector<vec2> uvs = out_.uvs[std::size_t(use.uv_set)];
    for (vec2& uv : uvs) uv = vec2(use.texture_from_uv * vec3(uv, 1));
    make_tangents(out_, uvs);
  }

  void mend_uvs_and_colors() {
    bool is_mended = false;
    const auto mend = [&](float& value) {
      if (std::isfinite(value)) return;
      value = 0;
      is_mended = true;
    };
    for (std::vector<vec2>& uvs : out_.uvs)
      for (vec2& uv : uvs)
        for (int c = 0; c < 2; ++c) mend(uv[c]);
    for (vec4& color : out_.colors)
      for (int c = 0; c < 4; ++c) mend(color[c]);
    if (is_mended)
      conversion_.notes.add("primitives with texture coordinates or colours not finite: set to 0");
  }

  Conversion& conversion_;
  const Primitive& from_;
  const std::string& place_;
  const Pose& pose_;
  VertexReader reader_;
  parity::Primitive out_;
};

}  // namespace

void Budget::spend(std::uint64_t bytes, const std::string& place) {
  if (bytes > left_)
    throw InputError(name_, place +
                                ": the geometry expands to more memory than a file of this size "
                                "may take");
  left_ -= bytes;
}

parity::Primitive convert_primitive(Conversion& conversion, const Primitive& from,
                                    const std::string& place, const Pose& pose) {
  return Builder(conversion, from, place, pose).build();
}

}  // namespace parity::gltf
