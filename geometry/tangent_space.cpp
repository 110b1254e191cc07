#include "geometry/tangent_space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

#include "geometry/gltf_topology.h"

namespace parity {
namespace {

constexpr int none = -1;

/// A triangle and what it knows of its neighbourhood. Edge i runs from corner i to corner i + 1.
struct Face {
  std::array<std::uint32_t, 3>
      welded{};                    ///< corners with equal position, normal and uv have one number
  dvec3 tangent{0.0};              ///< unit, along growing u; 0 where the uvs have no area
  bool keeps_orientation = false;  ///< the uvs run around the triangle as its corners do
  bool joins_any = true;           ///< no uv area: takes the orientation of its first group
  std::array<int, 3> neighbour{none, none, none};
  std::array<int, 3> group{none, none, none};
};

struct Group {
  bool keeps_orientation = false;
  std::vector<int> corners;  ///< 3 face + corner
};

bool is_not_zero(double value) { return std::abs(value) > std::numeric_limits<float>::min(); }

dvec3 unit_or_zero(const dvec3& v) {
  const double length = glm::length(v);
  return is_not_zero(length) ? v / length : dvec3(0.0);
}

/// The part of v across n, unit.
dvec3 across(const dvec3& v, const dvec3& n) { return unit_or_zero(v - n * glm::dot(n, v)); }

/// One number for vertices that agree in position, normal and uv.
std::vector<std::uint32_t> weld(const Primitive& primitive, const std::vector<vec2>& uvs) {
  const auto key = [&](std::uint32_t v) {
    const vec3 &p = primitive.positions[v], &n = primitive.normals[v];
    return std::tuple(p.x, p.y, p.z, n.x, n.y, n.z, uvs[v].x, uvs[v].y);
  };
  std::vector<std::uint32_t> order(primitive.positions.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::vector<std::uint32_t> welded(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    welded[order[i]] =
        i > 0 && key(order[i]) == key(order[i - 1]) ? welded[order[i - 1]] : order[i];
  return welded;
}

Face make_face(const Primitive& primitive, const std::vector<vec2>& uvs,
               const std::vector<std::uint32_t>& welded, std::size_t first) {
  Face face;
  std::array<dvec3, 3> p;
  std::array<dvec2, 3> t;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t v = primitive.indices[first + i];
    face.welded[i] = welded[v];
    p[i] = primitive.positions[v];
    t[i] = uvs[v];
  }
  const dvec2 t1 = t[1] - t[0], t2 = t[2] - t[0];
  const dvec3 d1 = p[1] - p[0], d2 = p[2] - p[0];
  const double area = t1.x * t2.y - t1.y * t2.x;
  face.keeps_orientation = area > 0;
  if (!is_not_zero(area)) return face;
  const dvec3 along_u = t2.y * d1 - t1.y * d2;
  const dvec3 along_v = t1.x * d2 - t2.x * d1;
  face.tangent = unit_or_zero(along_u) * (face.keeps_orientation ? 1.0 : -1.0);
  face.joins_any = !is_not_zero(glm::length(along_u) / std::abs(area)) ||
                   !is_not_zero(glm::length(along_v) / std::abs(area));
  return face;
}

/// Pairs faces over edges that run in opposite directions, the first free ones first.
void find_neighbours(std::vector<Face>& faces) {
  struct Edge {
    std::uint32_t low, high;
    int corner;
  };
  std::vector<Edge> edges;
  edges.reserve(3 * faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = faces[f].welded[i], b = faces[f].welded[(i + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), int(3 * f + i)});
    }
  std::ranges::sort(edges, [](const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high, a.corner) < std::tie(b.low, b.high, b.corner);
  });
  const auto slot = [&](const Edge& e) -> int& {
    return faces[std::size_t(e.corner / 3)].neighbour[std::size_t(e.corner % 3)];
  };
  const auto runs_up = [&](const Edge& e) {
    return faces[std::size_t(e.corner / 3)].welded[std::size_t(e.corner % 3)] == e.low;
  };
  for (std::size_t begin = 0; begin < edges.size();) {
    std::vector<const Edge*> up, down;
    std::size_t end = begin;
    for (; end < edges.size() && edges[end].low == edges[begin].low &&
           edges[end].high == edges[begin].high;
         ++end)
      (runs_up(edges[end]) ? up : down).push_back(&edges[end]);
    for (std::size_t i = 0; i < std::min(up.size(), down.size()); ++i) {
      slot(*up[i]) = down[i]->corner / 3;
      slot(*down[i]) = up[i]->corner / 3;
    }
    begin = end;
  }
}

/// Corners around one vertex that are linked by edges and have one orientation of the uvs.
std::vector<Group> make_groups(std::vector<Face>& faces) {
  std::vector<Group> groups;
  std::vector<int> open;
  for (std::size_t seed = 0; seed < 3 * faces.size(); ++seed) {
    const Face& start = faces[seed / 3];
    if (start.joins_any || start.group[seed % 3] != none) continue;
    const std::uint32_t vertex = start.welded[seed % 3];
    const int number = int(groups.size());
    Group group{.keeps_orientation = start.keeps_orientation, .corners = {}};
    open.assign(1, int(seed / 3));
    while (!open.empty()) {
      Face& face = faces[std::size_t(open.back())];
      const int index = open.back();
      open.pop_back();
      const std::size_t i =
          std::size_t(std::ranges::find(face.welded, vertex) - face.welded.begin());
      if (i == 3 || face.group[i] != none) continue;
      if (face.joins_any && face.group == std::array{none, none, none})
        face.keeps_orientation = group.keeps_orientation;
      if (face.keeps_orientation != group.keeps_orientation) continue;
      face.group[i] = number;
      group.corners.push_back(3 * index + int(i));
      for (const int next : {face.neighbour[(i + 2) % 3], face.neighbour[i]})
        if (next != none) open.push_back(next);
    }
    groups.push_back(std::move(group));
  }
  return groups;
}

/// The mean of the faces' tangents at their common vertex, weighted by the angle at the corner.
dvec3 mean_tangent(const Primitive& primitive, const std::vector<Face>& faces, const Group& group) {
  dvec3 sum{0.0};
  for (const int corner : group.corners) {
    const std::size_t first = std::size_t(corner / 3) * 3, i = std::size_t(corner % 3);
    const Face& face = faces[first / 3];
    if (face.joins_any) continue;
    const auto position = [&](std::size_t c) {
      return dvec3(primitive.positions[primitive.indices[first + c % 3]]);
    };
    const dvec3 n{primitive.normals[primitive.indices[first + i]]};
    const dvec3 back = across(position(i + 2) - position(i), n);
    const dvec3 ahead = across(position(i + 1) - position(i), n);
    sum += across(face.tangent, n) * std::acos(std::clamp(glm::dot(back, ahead), -1.0, 1.0));
  }
  return unit_or_zero(sum);
}

dvec3 any_tangent(const dvec3& normal) {
  const dvec3 axis = std::abs(normal.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
  return across(axis, normal);
}

/// Gives every (vertex, group) its own vertex; returns the group of each.
std::vector<int> split_vertices(Primitive& primitive, const std::vector<Face>& faces) {
  const std::size_t count = primitive.positions.size();
  constexpr int unseen = -2;
  std::vector<int> group_of(count, unseen);
  std::vector<std::uint32_t> source(count);
  std::iota(source.begin(), source.end(), 0u);
  std::map<std::pair<std::uint32_t, int>, std::uint32_t> copies;
  for (std::size_t c = 0; c < primitive.indices.size(); ++c) {
    std::uint32_t& index = primitive.indices[c];
    const int group = faces[c / 3].group[c % 3];
    if (group_of[index] == unseen) group_of[index] = group;
    if (group_of[index] == group) continue;
    const auto [copy, is_new] = copies.try_emplace({index, group}, std::uint32_t(source.size()));
    if (is_new) {
      source.push_back(index);
      group_of.push_back(group);
    }
    index = copy->second;
  }
  if (source.size() == count) return group_of;
  primitive.positions = gltf::pick(primitive.positions, source);
  primitive.normals = gltf::pick(primitive.normals, source);
  primitive.colors = gltf::pick(primitive.colors, source);
  for (std::vector<vec2>& uvs : primitive.uvs) uvs = gltf::pick(uvs, source);
  return group_of;
}

}  // namespace

void make_flat_normals(Primitive& primitive) {
  gltf::unshare_vertices(primitive);
  primitive.normals.resize(primitive.positions.size());
  for (std::size_t i = 0; i < primitive.positions.size(); i += 3) {
    const dvec3 origin{primitive.positions[i]};
    const dvec3 cross = glm::cross(dvec3(primitive.positions[i + 1]) - origin,
                                   dvec3(primitive.positions[i + 2]) - origin);
    const vec3 normal{cross / glm::length(cross)};
    std::fill_n(primitive.normals.begin() + std::ptrdiff_t(i), 3, normal);
  }
}

void make_tangents(Primitive& primitive, const std::vector<vec2>& uvs) {
  const std::vector<std::uint32_t> welded = weld(primitive, uvs);
  std::vector<Face> faces;
  faces.reserve(primitive.indices.size() / 3);
  for (std::size_t i = 0; i < primitive.indices.size(); i += 3)
    faces.push_back(make_face(primitive, uvs, welded, i));
  find_neighbours(faces);
  const std::vector<Group> groups = make_groups(faces);
  std::vector<vec4> tangent_of(groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g)
    tangent_of[g] = vec4(vec3(mean_tangent(primitive, faces, groups[g])),
                         groups[g].keeps_orientation ? -1.0f : 1.0f);
  const std::vector<int> group_of = split_vertices(primitive, faces);
  primitive.tangents.resize(group_of.size());
  for (std::size_t v = 0; v < group_of.size(); ++v) {
    vec4& tangent = primitive.tangents[v];
    tangent = group_of[v] < 0 ? vec4(0, 0, 0, 1) : tangent_of[std::size_t(group_of[v])];
    if (vec3(tangent) == vec3(0))
      tangent = vec4(vec3(any_tangent(dvec3(primitive.normals[v]))), tangent.w);
  }
}

}  // namespace parity
