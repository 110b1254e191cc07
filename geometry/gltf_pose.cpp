#include "geometry/gltf_pose.h"

#include <cmath>

#include "geometry/input_error.h"
#include "geometry/tangent_space.h"

namespace parity::gltf {
namespace {

/// Sums and lengths that quantisation to 8 bits keeps: four weights of 1/255, a normal of 1/127.
constexpr double quantization_slack = 0.02;

dvec3 unit(const dvec3& v) {
  const double length = glm::length(v);
  return length > 0 && std::isfinite(length) ? v / length : dvec3(0.0);
}

dvec3 any_perpendicular(const dvec3& n) {
  return unit(glm::cross(std::abs(n.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0), n));
}

/// JOINTS_n and WEIGHTS_n.
struct Influences {
  std::vector<uvec4> joints;
  std::vector<vec4> weights;
};

std::vector<Influences> read_influences(const VertexReader& reader, std::size_t joint_count,
                                        const std::string& place, const std::string& name) {
  std::vector<Influences> sets;
  for (std::string set = "0"; reader.has("JOINTS_" + set) && reader.has("WEIGHTS_" + set);
       set = std::to_string(sets.size())) {
    sets.push_back(
        {reader.read_joints("JOINTS_" + set), reader.read<vec4>("WEIGHTS_" + set, true)});
    for (const uvec4& joints : sets.back().joints)
      for (int i = 0; i < 4; ++i)
        if (joints[i] >= joint_count)
          throw InputError(name, place + ".attributes.JOINTS_" + set + ": joint " +
                                     std::to_string(joints[i]) + ", but the skin has " +
                                     std::to_string(joint_count));
  }
  return sets;
}

struct Blend {
  dmat4 matrix{0.0};
  double weight = 0;
};

Blend blend_at(const std::vector<Influences>& sets, std::span<const dmat4> skin_matrices,
               std::size_t vertex) {
  Blend blend;
  for (const Influences& set : sets)
    for (int i = 0; i < 4; ++i) {
      const double weight = double(set.weights[vertex][i]);
      if (!(weight > 0) || !std::isfinite(weight)) continue;
      blend.matrix += skin_matrices[set.joints[vertex][i]] * weight;
      blend.weight += weight;
    }
  return blend;
}

void transform_vertex(const dmat4& m, std::size_t v, parity::Primitive& primitive) {
  primitive.positions[v] = vec3(m * dvec4(dvec3(primitive.positions[v]), 1));
  const dmat3 linear{m};
  // The cofactors turn normals as the inverse transpose does, and exist for all matrices.
  const dmat3 cofactors{glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                        glm::cross(linear[0], linear[1])};
  const double side = glm::determinant(linear) < 0 ? -1 : 1;
  if (!primitive.normals.empty())
    primitive.normals[v] = vec3(side * unit(cofactors * unit(dvec3(primitive.normals[v]))));
  if (!primitive.tangents.empty())
    primitive.tangents[v] = vec4(vec3(unit(linear * dvec3(primitive.tangents[v]))),
                                 primitive.tangents[v].w * float(side));
}

/// The mean of the adjacent faces, weighted by area, where a normal is 0.
void replace_zero_normals(parity::Primitive& primitive) {
  const std::vector<std::uint32_t>& indices = primitive.indices;
  std::vector<dvec3> sum(primitive.normals.size(), dvec3(0.0));
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    const dvec3 origin{primitive.positions[indices[i]]};
    const dvec3 area = glm::cross(dvec3(primitive.positions[indices[i + 1]]) - origin,
                                  dvec3(primitive.positions[indices[i + 2]]) - origin);
    for (std::size_t c = 0; c < 3; ++c) sum[indices[i + c]] += area;
  }
  for (std::size_t v = 0; v < sum.size(); ++v) {
    if (primitive.normals[v] != vec3(0)) continue;
    const dvec3 mean = unit(sum[v]);
    primitive.normals[v] = mean == dvec3(0.0) ? vec3(0, 0, 1) : vec3(mean);
  }
}

}  // namespace

void apply_morph(const VertexReader& reader, std::span<const double> weights,
                 parity::Primitive& primitive) {
  for (std::size_t t = 0; t < weights.size(); ++t) {
    const float weight = float(weights[t]);
    if (weight == 0) continue;
    const auto add = [&](const char* semantic, auto& values) {
      if (values.empty()) return;
      const std::vector<vec3> delta = reader.read_target(t, semantic);
      for (std::size_t i = 0; i < delta.size(); ++i)
        for (int c = 0; c < 3; ++c) values[i][c] += weight * delta[i][c];
    };
    add("POSITION", primitive.positions);
    add("NORMAL", primitive.normals);
    add("TANGENT", primitive.tangents);
  }
}

void apply_skin(const VertexReader& reader, std::span<const dmat4> skin_matrices,
                const std::string& place, Conversion& conversion, parity::Primitive& primitive) {
  const std::vector<Influences> sets =
      read_influences(reader, skin_matrices.size(), place, conversion.name);
  bool is_uneven = false;
  for (std::size_t v = 0; v < primitive.positions.size(); ++v) {
    const Blend blend = blend_at(sets, skin_matrices, v);
    is_uneven = is_uneven || std::abs(blend.weight - 1) > quantization_slack;
    transform_vertex(blend.weight > 0 ? blend.matrix / blend.weight : skin_matrices[0], v,
                     primitive);
  }
  if (is_uneven) conversion.notes.add("primitives with joint weights that do not sum to 1: scaled");
}

void finish_normals(parity::Primitive& primitive, Notes& notes) {
  if (primitive.normals.empty()) return make_flat_normals(primitive);
  bool is_off = false, is_zero = false;
  for (vec3& normal : primitive.normals) {
    const double length = glm::length(dvec3(normal));
    is_off = is_off || std::abs(length - 1) > quantization_slack;
    normal = length > 1e-6 ? vec3(unit(dvec3(normal))) : vec3(0);
    is_zero = is_zero || normal == vec3(0);
  }
  if (is_off) notes.add("primitives with normals that were not unit: normalised");
  if (!is_zero) return;
  notes.add("primitives with normals of length 0: taken from the faces");
  replace_zero_normals(primitive);
}

void normalize_tangents(parity::Primitive& primitive, Notes& notes) {
  bool is_mended = false;
  for (std::size_t v = 0; v < primitive.tangents.size(); ++v) {
    vec4& tangent = primitive.tangents[v];
    const double length = glm::length(dvec3(tangent));
    is_mended = is_mended || !(std::abs(length - 1) <= quantization_slack) ||
                !(std::abs(std::abs(double(tangent.w)) - 1) <= quantization_slack);
    dvec3 direction = unit(dvec3(tangent));
    if (direction == dvec3(0.0)) direction = any_perpendicular(dvec3(primitive.normals[v]));
    tangent = vec4(vec3(direction), tangent.w < 0 ? -1.0f : 1.0f);
  }
  if (is_mended) notes.add("primitives with tangents that were not unit: normalised");
}

}  // namespace parity::gltf
