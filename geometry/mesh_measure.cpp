#include "geometry/mesh_measure.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include "geometry/input_error.h"
#include "geometry/mesh_triangulate.h"

namespace parity {
namespace {

constexpr std::size_t most_faces_allowed_at_edge = 4;

/// Sets that grow together.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t(0));
  }

  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void unite(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// One side of a face: the edge between two vertices, low < high, as that face goes along it.
struct Side {
  std::uint32_t low = 0;
  std::uint32_t high = 0;
  std::uint32_t low_corner = 0;
  std::uint32_t high_corner = 0;
  std::uint32_t face = 0;
  bool goes_up = false;  ///< from low to high
};

std::vector<Side> sorted_sides(const Mesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(mesh.corners.size());
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    const std::uint32_t begin = mesh.face_begin[face], end = mesh.face_begin[face + 1];
    for (std::uint32_t c = begin; c < end; ++c) {
      const std::uint32_t next = c + 1 == end ? begin : c + 1;
      const std::uint32_t from = mesh.corners[c], to = mesh.corners[next];
      if (from < to) sides.push_back({from, to, c, next, face, true});
      if (from > to) sides.push_back({to, from, next, c, face, false});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.low_corner) < std::tie(b.low, b.high, b.low_corner);
  });
  return sides;
}

/// Calls `visit` with the sides of each edge.
template <typename Visit>
void for_each_edge(std::span<const Side> sides, Visit visit) {
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].low == sides[begin].low &&
           sides[end].high == sides[begin].high)
      ++end;
    visit(sides.subspan(begin, end - begin));
  }
}

void count_faces(const Mesh& mesh, MeshReport& report) {
  report.faces = mesh.face_count();
  for (std::size_t face = 0; face < mesh.face_count(); ++face) {
    const std::size_t corners = mesh.face_begin[face + 1] - mesh.face_begin[face];
    ++(corners == 3 ? report.triangles : corners == 4 ? report.quads : report.polygons);
  }
}

void count_edges(std::span<const Side> sides, MeshReport& report) {
  for_each_edge(sides, [&](std::span<const Side> edge) {
    ++report.edges;
    if (edge.size() == 1) ++report.boundary_edges;
    if (edge.size() == 2 && edge[0].goes_up == edge[1].goes_up) ++report.misoriented_edges;
    if (edge.size() > 2) ++report.nonmanifold_edges;
    if (edge.size() > report.most_faces_at_edge) {
      report.most_faces_at_edge = edge.size();
      report.crowded_edge = {edge[0].low, edge[0].high};
    }
  });
  report.oriented = report.misoriented_edges == 0;
  report.closed = report.faces > 0 && report.boundary_edges == 0;
}

/// The corners at a vertex that faces with common edges there hang together by.
DisjointSets fans_of(const Mesh& mesh, std::span<const Side> sides) {
  DisjointSets fans{mesh.corners.size()};
  for_each_edge(sides, [&](std::span<const Side> edge) {
    for (const Side& side : edge) {
      fans.unite(edge[0].low_corner, side.low_corner);
      fans.unite(edge[0].high_corner, side.high_corner);
    }
  });
  return fans;
}

void count_nonmanifold_vertices(const Mesh& mesh, DisjointSets& fans, MeshReport& report) {
  std::vector<std::uint32_t> fan_count(mesh.vertex_count(), 0);
  for (std::uint32_t c = 0; c < mesh.corners.size(); ++c)
    if (fans.root(c) == c) ++fan_count[mesh.corners[c]];
  for (std::uint32_t v = 0; v < fan_count.size(); ++v) {
    if (fan_count[v] < 2) continue;
    ++report.nonmanifold_vertices;
    if (!report.first_nonmanifold_vertex) report.first_nonmanifold_vertex = v;
  }
  report.unused_vertices = std::size_t(std::count(fan_count.begin(), fan_count.end(), 0u));
}

/// Boundary edges that follow each other through a fan belong to one loop.
void count_boundary_loops(std::span<const Side> sides, const DisjointSets& fans,
                          MeshReport& report) {
  DisjointSets loops = fans;
  std::vector<std::uint32_t> corners;
  for_each_edge(sides, [&](std::span<const Side> edge) {
    if (edge.size() != 1) return;
    loops.unite(edge[0].low_corner, edge[0].high_corner);
    corners.push_back(edge[0].low_corner);
  });
  for (std::uint32_t& corner : corners) corner = loops.root(corner);
  std::sort(corners.begin(), corners.end());
  report.boundary_loops =
      std::size_t(std::unique(corners.begin(), corners.end()) - corners.begin());
}

void count_components(const Mesh& mesh, MeshReport& report) {
  DisjointSets components{mesh.vertex_count()};
  std::vector<bool> is_used(mesh.vertex_count(), false);
  for (std::size_t face = 0; face < mesh.face_count(); ++face)
    for (std::size_t c = mesh.face_begin[face]; c < mesh.face_begin[face + 1]; ++c) {
      components.unite(mesh.corners[mesh.face_begin[face]], mesh.corners[c]);
      is_used[mesh.corners[c]] = true;
    }
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
    if (is_used[v] && components.root(v) == v) ++report.components;
}

/// Every face stands twice, as it is and turned over. An edge of two faces ties the sides that go
/// with each other; the surface has one side only if some face is tied to itself turned over.
bool is_orientable(const Mesh& mesh, std::span<const Side> sides) {
  const auto count = std::uint32_t(mesh.face_count());
  DisjointSets sets{2 * std::size_t(count)};
  for_each_edge(sides, [&](std::span<const Side> edge) {
    if (edge.size() != 2) return;
    const std::uint32_t turn = edge[0].goes_up == edge[1].goes_up ? count : 0;
    sets.unite(edge[0].face, edge[1].face + turn);
    sets.unite(edge[0].face + count, edge[1].face + count - turn);
  });
  for (std::uint32_t face = 0; face < count; ++face)
    if (sets.root(face) == sets.root(face + count)) return false;
  return true;
}

void count_pinched_and_duplicate_faces(const Mesh& mesh, MeshReport& report) {
  std::vector<std::uint32_t> corners = mesh.corners;
  std::vector<std::span<const std::uint32_t>> faces;
  for (std::size_t face = 0; face < mesh.face_count(); ++face) {
    const std::span<std::uint32_t> own{corners.data() + mesh.face_begin[face],
                                       corners.data() + mesh.face_begin[face + 1]};
    std::sort(own.begin(), own.end());
    if (std::adjacent_find(own.begin(), own.end()) != own.end()) ++report.pinched_faces;
    faces.emplace_back(own);
  }
  std::sort(faces.begin(), faces.end(), [](const auto& a, const auto& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  });
  for (std::size_t i = 1; i < faces.size(); ++i)
    if (std::equal(faces[i].begin(), faces[i].end(), faces[i - 1].begin(), faces[i - 1].end()))
      ++report.duplicate_faces;
}

void count_duplicate_vertices(const Mesh& mesh, MeshReport& report) {
  std::vector<std::array<float, 3>> places;
  std::vector<std::uint32_t> used = mesh.corners;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (std::uint32_t vertex : used) {
    const vec3& p = mesh.positions[vertex];
    places.push_back({p.x, p.y, p.z});
  }
  std::sort(places.begin(), places.end());
  report.duplicate_vertices = std::size_t(places.end() - std::unique(places.begin(), places.end()));
}

void measure_bounds(const Mesh& mesh, MeshReport& report) {
  if (mesh.corners.empty()) return;
  report.min = report.max = dvec3(mesh.positions[mesh.corners[0]]);
  for (std::uint32_t vertex : mesh.corners) {
    report.min = glm::min(report.min, dvec3(mesh.positions[vertex]));
    report.max = glm::max(report.max, dvec3(mesh.positions[vertex]));
  }
}

void count_degenerate_triangles(const Mesh& mesh, MeshReport& report) {
  const auto place = [&](std::size_t corner) {
    return dvec3(mesh.positions[mesh.corners[corner]]);
  };
  for (std::size_t face = 0; face < mesh.face_count(); ++face) {
    const std::size_t first = mesh.face_begin[face];
    for (std::size_t c = first + 1; c + 1 < mesh.face_begin[face + 1]; ++c)
      if (glm::cross(place(c) - place(first), place(c + 1) - place(first)) == dvec3(0.0))
        ++report.degenerate_triangles;
  }
}

/// Area, and volume as the sum of tetrahedra from the middle of the bounds.
void measure_sizes(const Mesh& mesh, MeshReport& report) {
  const dvec3 middle = 0.5 * (report.min + report.max);
  double volume = 0.0;
  const std::vector<CornerTriangle> triangles = triangulate(mesh);
  for (const CornerTriangle& triangle : triangles) {
    dvec3 p[3];
    for (int i = 0; i < 3; ++i)
      p[i] = dvec3(mesh.positions[mesh.corners[triangle[std::size_t(i)]]]);
    report.area += 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
    volume += glm::dot(p[0] - middle, glm::cross(p[1] - middle, p[2] - middle)) / 6.0;
  }
  report.triangles_when_cut = triangles.size();
  if (report.closed && report.manifold && report.oriented) report.volume = volume;
}

void find_genus(MeshReport& report) {
  const auto used = std::int64_t(report.vertices - report.unused_vertices);
  report.euler_characteristic = used - std::int64_t(report.edges) + std::int64_t(report.faces);
  if (!report.manifold) return;
  const std::int64_t sides = 2 * std::int64_t(report.components) -
                             std::int64_t(report.boundary_loops) - report.euler_characteristic;
  if (report.orientable)
    report.genus = sides / 2;
  else
    report.nonorientable_genus = sides;
}

}  // namespace

MeshReport measure(const Mesh& mesh) {
  MeshReport report;
  report.vertices = mesh.vertex_count();
  const std::vector<Side> sides = sorted_sides(mesh);
  count_faces(mesh, report);
  count_edges(sides, report);
  DisjointSets fans = fans_of(mesh, sides);
  count_nonmanifold_vertices(mesh, fans, report);
  count_boundary_loops(sides, fans, report);
  count_components(mesh, report);
  count_pinched_and_duplicate_faces(mesh, report);
  count_duplicate_vertices(mesh, report);
  count_degenerate_triangles(mesh, report);
  report.manifold = report.nonmanifold_edges == 0 && report.nonmanifold_vertices == 0 &&
                    report.pinched_faces == 0;
  report.orientable = is_orientable(mesh, sides);
  measure_bounds(mesh, report);
  measure_sizes(mesh, report);
  find_genus(report);
  return report;
}

void refuse_crowded_edges(const MeshReport& report, const std::string& name) {
  if (report.most_faces_at_edge > most_faces_allowed_at_edge)
    throw InputError(
        name, std::to_string(report.most_faces_at_edge) + " faces meet at the edge of vertices " +
                  std::to_string(report.crowded_edge[0]) + " and " +
                  std::to_string(report.crowded_edge[1]) + " (from 0), expected at most " +
                  std::to_string(most_faces_allowed_at_edge));
}

}  // namespace parity
