#include "geometry/gltf_primitive.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/gltf_compression.h"
#include "geometry/input_error.h"
#include "geometry/tangent_space.h"

namespace parity::gltf {
namespace {

/// Reads the attributes of one primitive, from its accessors or from its Draco mesh, for the
/// vertices that are drawn.
class VertexReader {
 public:
  VertexReader(Conversion& conversion, const Primitive& from, const std::string& place)
      : conversion_(conversion), from_(from), place_(place) {
    if (from.draco) decode_draco_mesh();
  }

  bool has(const std::string& semantic) const { return from_.attributes.contains(semantic); }

  std::size_t total_vertex_count() const {
    return draco_ ? draco_->vertex_count
                  : std::size_t(accessor(from_.attributes.at("POSITION")).count);
  }

  std::vector<std::uint32_t> indices() {
    if (draco_) return std::move(draco_->indices);
    if (from_.indices >= 0) {
      const std::uint64_t count = accessor(from_.indices).count;
      conversion_.budget.spend(4 * count, place_);
      return conversion_.data.read_unsigned(from_.indices);
    }
    conversion_.budget.spend(4 * total_vertex_count(), place_);
    std::vector<std::uint32_t> all(total_vertex_count());
    std::iota(all.begin(), all.end(), 0u);
    return all;
  }

  /// From here on only these vertices; empty: all.
  void select(std::vector<std::uint32_t> which) { which_ = std::move(which); }
  std::size_t vertex_count() const { return which_.empty() ? total_vertex_count() : which_.size(); }
  const std::vector<std::uint32_t>& which() const { return which_; }

  int components(const std::string& semantic) const {
    return accessor(from_.attributes.at(semantic)).components;
  }

  template <typename Vector>
  std::vector<Vector> read(const std::string& semantic, bool force_normalized) const {
    if (!has(semantic)) return {};
    if (!draco_ || !draco_->attributes.contains(semantic))
      return conversion_.data.read<Vector>(from_.attributes.at(semantic), which_, force_normalized);
    const std::vector<float>& values = draco_->attributes.at(semantic);
    std::vector<Vector> vectors(vertex_count());
    for (std::size_t i = 0; i < vectors.size(); ++i)
      for (int c = 0; c < Vector::length(); ++c)
        vectors[i][c] = values[(which_.empty() ? i : which_[i]) * std::size_t(Vector::length()) +
                               std::size_t(c)];
    return vectors;
  }

  std::vector<uvec4> read_joints(const std::string& semantic) const {
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

 private:
  const Accessor& accessor(int index) const {
    return conversion_.document.accessors[std::size_t(index)];
  }

  void decode_draco_mesh() {
    const std::string place = place_ + ".extensions.KHR_draco_mesh_compression";
    std::map<std::string, int> wanted;
    for (const auto& [semantic, index] : from_.attributes)
      wanted[semantic] = accessor(index).components;
    if (!from_.draco->attributes.contains("POSITION"))
      throw InputError(conversion_.name, place + ".attributes.POSITION is missing");
    draco_ = decode_draco(from_.draco->attributes, wanted, conversion_.data.view(from_.draco->view),
                          conversion_.name, place);
    for (const auto& [semantic, index] : from_.attributes)
      if (!draco_->attributes.contains(semantic) && accessor(index).count != draco_->vertex_count)
        throw InputError(conversion_.name, place_ + ".attributes." + semantic + " has " +
                                               std::to_string(accessor(index).count) +
                                               " elements, the Draco mesh has " +
                                               std::to_string(draco_->vertex_count));
    conversion_.budget.spend(std::uint64_t(draco_->vertex_count) * 64 + draco_->indices.size() * 4,
                             place);
  }

  Conversion& conversion_;
  const Primitive& from_;
  const std::string& place_;
  std::optional<DracoMesh> draco_;
  std::vector<std::uint32_t> which_;
};

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
    // Position, normal, tangent, colour, one pair of uvs and room for splitting them.
    conversion_.budget.spend(std::uint64_t(reader_.vertex_count()) * 64, place_);
    read_vertices();
    morph();
    skin();
    drop_unusable(out_, conversion_.notes);
    if (out_.indices.empty()) return std::move(out_);
    if (out_.topology == Topology::triangles) finish_normals();
    mend_uvs_and_colors();
    finish_tangents();
    return std::move(out_);
  }

 private:
  const Material* material() const {
    return from_.material < 0 ? nullptr
                              : &conversion_.document.materials[std::size_t(from_.material)];
  }

  void read_indices() {
    std::vector<std::uint32_t> indices = reader_.indices();
    const std::size_t count = reader_.total_vertex_count();
    for (std::size_t i = 0; i < indices.size(); ++i)
      if (indices[i] >= count)
        throw InputError(conversion_.name, place_ + ".indices: element " + std::to_string(i) +
                                               " is " + std::to_string(indices[i]) +
                                               ", but there are " + std::to_string(count) +
                                               " vertices");
    conversion_.budget.spend(from_.mode > 4 ? 12 * indices.size() : 0, place_);
    out_.indices = expand(from_.draco ? 4 : from_.mode, std::move(indices), conversion_.notes);
    if (!out_.indices.empty()) reader_.select(compact(out_.indices, count));
  }

  void read_vertices() {
    out_.positions = reader_.read<vec3>("POSITION", false);
    check_declared_box();
    out_.normals = reader_.read<vec3>("NORMAL", true);
    if (maps_normals()) out_.tangents = reader_.read<vec4>("TANGENT", true);
    read_uvs();
    if (!reader_.has("COLOR_0")) return;
    if (reader_.components("COLOR_0") == 4) {
      out_.colors = reader_.read<vec4>("COLOR_0", true);
      return;
    }
    for (const vec3& color : reader_.read<vec3>("COLOR_0", true))
      out_.colors.emplace_back(color, 1.0f);
  }

  /// min and max are advice: they are compared, never used.
  void check_declared_box() {
    const Accessor& a =
        conversion_.document.accessors[std::size_t(from_.attributes.at("POSITION"))];
    if (a.min.size() != 3 || a.max.size() != 3) return;
    const bool is_raw = a.normalized && a.component != ComponentType::float32;
    if (is_raw) return;
    for (const vec3& p : out_.positions)
      for (int c = 0; c < 3; ++c) {
        const double slack =
            1e-5 * std::max(std::abs(a.min[std::size_t(c)]), std::abs(a.max[std::size_t(c)]));
        if (double(p[c]) >= a.min[std::size_t(c)] - slack &&
            double(p[c]) <= a.max[std::size_t(c)] + slack)
          continue;
        if (std::isfinite(p[c]))
          return conversion_.notes.add("POSITION accessors whose min and max do not hold");
      }
  }

  bool maps_normals() const {
    return out_.topology == Topology::triangles && material() &&
           material()->normal_texture.texture >= 0;
  }

  void read_uvs() {
    if (!material()) return;
    const Material& m = *material();
    for (const TextureUse* use : {&m.base_color_texture, &m.metallic_roughness_texture,
                                  &m.normal_texture, &m.occlusion_texture, &m.emission_texture}) {
      if (use->texture < 0) continue;
      const std::size_t set = std::size_t(use->uv_set);
      if (out_.uvs.size() <= set) out_.uvs.resize(set + 1);
      if (!out_.uvs[set].empty()) continue;
      const std::string semantic = "TEXCOORD_" + std::to_string(set);
      out_.uvs[set] = reader_.read<vec2>(semantic, false);
      if (!reader_.has(semantic)) {
        out_.uvs[set].assign(out_.positions.size(), vec2(0));
        conversion_.notes.add("primitives without the texture coordinates of their material");
      }
    }
  }

  void morph() {
    for (std::size_t t = 0; t < from_.targets.size() && t < pose_.weights.size(); ++t) {
      const float weight = float(pose_.weights[t]);
      if (weight == 0) continue;
      const auto add = [&](const char* semantic, auto& values) {
        const auto found = from_.targets[t].find(semantic);
        if (found == from_.targets[t].end() || values.empty()) return;
        const std::vector<vec3> delta = conversion_.data.read<vec3>(found->second, reader_.which());
        for (std::size_t i = 0; i < values.size(); ++i)
          for (int c = 0; c < 3; ++c) values[i][c] += weight * delta[i][c];
      };
      add("POSITION", out_.positions);
      add("NORMAL", out_.normals);
      add("TANGENT", out_.tangents);
    }
  }

  void skin() {
    if (pose_.skin_matrices.empty()) return;
    std::vector<dmat4> blend(out_.positions.size(), dmat4(0.0));
    std::vector<double> total(blend.size(), 0.0);
    for (int set = 0; reader_.has("JOINTS_" + std::to_string(set)); ++set)
      add_influences(std::to_string(set), blend, total);
    bool uneven = false;
    for (std::size_t v = 0; v < blend.size(); ++v) {
      uneven = uneven || std::abs(total[v] - 1) > 0.02;
      const dmat4 m = total[v] > 0 ? blend[v] * (1 / total[v]) : pose_.skin_matrices[0];
      out_.positions[v] = vec3(m * dvec4(dvec3(out_.positions[v]), 1));
      const dmat3 linear{m};
      // The cofactors turn normals as the inverse transpose does, and exist for all matrices.
      const dmat3 cofactors{glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                            glm::cross(linear[0], linear[1])};
      const double side = glm::determinant(linear) < 0 ? -1 : 1;
      if (!out_.normals.empty())
        out_.normals[v] = vec3(side * unit(cofactors * unit(dvec3(out_.normals[v]))));
      if (!out_.tangents.empty())
        out_.tangents[v] =
            vec4(vec3(unit(linear * dvec3(out_.tangents[v]))), out_.tangents[v].w * float(side));
    }
    if (uneven) conversion_.notes.add("primitives with joint weights that do not sum to 1: scaled");
  }

  static dvec3 unit(const dvec3& v) {
    const double length = glm::length(v);
    return length > 0 && std::isfinite(length) ? v / length : dvec3(0.0);
  }

  void add_influences(const std::string& set, std::vector<dmat4>& blend,
                      std::vector<double>& total) const {
    const std::vector<uvec4> joints = reader_.read_joints("JOINTS_" + set);
    const std::vector<vec4> weights = reader_.read<vec4>("WEIGHTS_" + set, true);
    for (std::size_t v = 0; v < blend.size(); ++v)
      for (int i = 0; i < 4; ++i) {
        if (joints[v][i] >= pose_.skin_matrices.size())
          throw InputError(conversion_.name, place_ + ".attributes.JOINTS_" + set + ": joint " +
                                                 std::to_string(joints[v][i]) +
                                                 ", but the skin has " +
                                                 std::to_string(pose_.skin_matrices.size()));
        const double weight = weights.empty() ? 0.0 : double(weights[v][i]);
        if (!(weight > 0) || !std::isfinite(weight)) continue;
        blend[v] += pose_.skin_matrices[joints[v][i]] * weight;
        total[v] += weight;
      }
  }

  void finish_normals() {
    if (out_.normals.empty()) return make_flat_normals(out_);
    bool off = false, zero = false;
    for (vec3& normal : out_.normals) {
      const float length = glm::length(normal);
      if (!(length > 1e-6f) || !std::isfinite(length)) {
        zero = true;
        normal = vec3(0);
        continue;
      }
      off = off || std::abs(length - 1) > 0.02f;
      normal /= length;
    }
    if (off) conversion_.notes.add("primitives with normals that were not unit: normalised");
    if (zero) replace_zero_normals();
  }

  /// The mean of the adjacent faces, weighted by area, where the file gives no direction.
  void replace_zero_normals() {
    conversion_.notes.add("primitives with normals of length 0: taken from the faces");
    std::vector<dvec3> sum(out_.normals.size(), dvec3(0.0));
    for (std::size_t i = 0; i < out_.indices.size(); i += 3) {
      const dvec3 origin{out_.positions[out_.indices[i]]};
      const dvec3 area = glm::cross(dvec3(out_.positions[out_.indices[i + 1]]) - origin,
                                    dvec3(out_.positions[out_.indices[i + 2]]) - origin);
      for (std::size_t c = 0; c < 3; ++c) sum[out_.indices[i + c]] += area;
    }
    for (std::size_t v = 0; v < sum.size(); ++v)
      if (out_.normals[v] == vec3(0)) {
        const dvec3 mean = unit(sum[v]);
        out_.normals[v] = mean == dvec3(0.0) ? vec3(0, 0, 1) : vec3(mean);
      }
  }

  void mend_uvs_and_colors() {
    bool mended = false;
    const auto mend = [&](float& value) {
      if (std::isfinite(value)) return;
      value = 0;
      mended = true;
    };
    for (std::vector<vec2>& uvs : out_.uvs)
      for (vec2& uv : uvs)
        for (int c = 0; c < 2; ++c) mend(uv[c]);
    for (vec4& color : out_.colors)
      for (int c = 0; c < 4; ++c) mend(color[c]);
    if (mended)
      conversion_.notes.add("primitives with texture coordinates or colours not finite: set to 0");
  }

  void finish_tangents() {
    if (!maps_normals()) return;
    if (out_.tangents.size() == out_.positions.size() && !out_.tangents.empty())
      return normalize_tangents();
    const TextureUse& use = material()->normal_texture;
    std::vector<vec2> uvs = out_.uvs[std::size_t(use.uv_set)];
    for (vec2& uv : uvs) uv = vec2(use.texture_from_uv * vec3(uv, 1));
    make_tangents(out_, uvs);
  }

  void normalize_tangents() {
    bool mended = false;
    for (std::size_t v = 0; v < out_.tangents.size(); ++v) {
      vec4& tangent = out_.tangents[v];
      dvec3 direction = unit(dvec3(tangent));
      if (direction == dvec3(0.0)) {
        const dvec3 n{out_.normals[v]};
        direction = unit(glm::cross(std::abs(n.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0), n));
        mended = true;
      }
      mended = mended || std::abs(std::abs(tangent.w) - 1) > 0.02f ||
               std::abs(glm::length(vec3(tangent)) - 1) > 0.02f;
      tangent = vec4(vec3(direction), tangent.w < 0 ? -1.0f : 1.0f);
    }
    if (mended) conversion_.notes.add("primitives with tangents that were not unit: normalised");
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
                                ": the file's geometry expands to more memory than a file of "
                                "its size may take");
  left_ -= bytes;
}

parity::Primitive convert_primitive(Conversion& conversion, const Primitive& from,
                                    const std::string& place, const Pose& pose) {
  return Builder(conversion, from, place, pose).build();
}

}  // namespace parity::gltf
