#include "geometry/gltf_topology.h"

#include <algorithm>
#include <cmath>

namespace parity::gltf {
namespace {

bool is_finite(const vec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// Applies a selection to everything that a vertex has.
void pick_vertices(parity::Primitive& primitive, const std::vector<std::uint32_t>& which) {
  if (which.empty()) return;
  primitive.positions = pick(primitive.positions, which);
  primitive.normals = pick(primitive.normals, which);
  primitive.tangents = pick(primitive.tangents, which);
  primitive.colors = pick(primitive.colors, which);
  for (std::vector<vec2>& uvs : primitive.uvs) uvs = pick(uvs, which);
}

bool has_area(const vec3& a, const vec3& b, const vec3& c) {
  const dvec3 origin{a};
  const dvec3 normal = glm::cross(dvec3(b) - origin, dvec3(c) - origin);
  return normal != dvec3(0.0);
}

std::vector<std::uint32_t> expand_strip(const std::vector<std::uint32_t>& in) {
  std::vector<std::uint32_t> out;
  for (std::size_t i = 0; i + 2 < in.size(); ++i) {
    const std::size_t odd = i % 2;
    out.insert(out.end(), {in[i], in[i + 1 + odd], in[i + 2 - odd]});
  }
  return out;
}

std::vector<std::uint32_t> expand_fan(const std::vector<std::uint32_t>& in) {
  std::vector<std::uint32_t> out;
  for (std::size_t i = 1; i + 1 < in.size(); ++i) out.insert(out.end(), {in[i], in[i + 1], in[0]});
  return out;
}

std::vector<std::uint32_t> expand_line_strip(const std::vector<std::uint32_t>& in, bool closed) {
  std::vector<std::uint32_t> out;
  for (std::size_t i = 0; i + 1 < in.size(); ++i) out.insert(out.end(), {in[i], in[i + 1]});
  if (closed && in.size() > 1) out.insert(out.end(), {in.back(), in.front()});
  return out;
}

}  // namespace

std::vector<std::string> Notes::sentences() const {
  std::vector<std::string> list;
  for (const auto& [what, count] : counts_) list.push_back(what + ": " + std::to_string(count));
  return list;
}

Topology topology_of(int mode) {
  if (mode == 0) return Topology::points;
  return mode < 4 ? Topology::lines : Topology::triangles;
}

std::vector<std::uint32_t> expand(int mode, std::vector<std::uint32_t> indices, Notes& notes) {
  const std::size_t corners = mode == 0 ? 1 : mode < 4 ? 2 : 3;
  const bool is_list = mode == 0 || mode == 1 || mode == 4;
  const std::size_t rest = is_list ? indices.size() % corners : 0;
  if (rest > 0 || indices.size() < corners)
    notes.add("indices left over after the last complete element",
              rest > 0 ? rest : indices.size());
  if (mode == 2 || mode == 3) return expand_line_strip(indices, mode == 2);
  if (mode == 5) return expand_strip(indices);
  if (mode == 6) return expand_fan(indices);
  indices.resize(indices.size() - rest);
  return indices;
}

std::vector<std::uint32_t> compact(std::vector<std::uint32_t>& indices, std::size_t vertex_count) {
  if (indices.size() < vertex_count / 16) {
    std::vector<std::uint32_t> used = indices;
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (std::uint32_t& index : indices)
      index = std::uint32_t(std::ranges::lower_bound(used, index) - used.begin());
    return used;
  }
  std::vector<bool> is_used(vertex_count);
  for (std::uint32_t index : indices) is_used[index] = true;
  if (std::ranges::find(is_used, false) == is_used.end()) return {};
  std::vector<std::uint32_t> used, place(vertex_count);
  for (std::size_t v = 0; v < vertex_count; ++v) {
    if (!is_used[v]) continue;
    place[v] = std::uint32_t(used.size());
    used.push_back(std::uint32_t(v));
  }
  for (std::uint32_t& index : indices) index = place[index];
  return used;
}

void unshare_vertices(parity::Primitive& primitive) {
  pick_vertices(primitive, primitive.indices);
  for (std::size_t i = 0; i < primitive.indices.size(); ++i)
    primitive.indices[i] = std::uint32_t(i);
}

void drop_unusable(parity::Primitive& primitive, Notes& notes) {
  const std::size_t corners = primitive.topology == Topology::points  ? 1
                              : primitive.topology == Topology::lines ? 2
                                                                      : 3;
  std::vector<std::uint32_t>& indices = primitive.indices;
  std::uint64_t not_finite = 0, degenerate = 0;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < indices.size(); i += corners) {
    bool finite = true;
    for (std::size_t c = 0; c < corners; ++c)
      finite = finite && is_finite(primitive.positions[indices[i + c]]);
    const bool flat =
        finite && corners == 3 &&
        !has_area(primitive.positions[indices[i]], primitive.positions[indices[i + 1]],
                  primitive.positions[indices[i + 2]]);
    not_finite += !finite;
    degenerate += flat;
    if (!finite || flat) continue;
    for (std::size_t c = 0; c < corners; ++c) indices[kept++] = indices[i + c];
  }
  notes.add("elements left out because a position is not finite", not_finite);
  notes.add("triangles without area left out", degenerate);
  if (kept == indices.size()) return;
  indices.resize(kept);
  pick_vertices(primitive, compact(indices, primitive.positions.size()));
  if (indices.empty())
    primitive = {.topology = primitive.topology,
                 .material = primitive.material,
                 .indices = {},
                 .positions = {},
                 .normals = {},
                 .tangents = {},
                 .uvs = {},
                 .colors = {}};
}

}  // namespace parity::gltf
