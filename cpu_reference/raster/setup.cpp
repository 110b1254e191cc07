#include "cpu_reference/raster/setup.h"

#include <algorithm>
#include <limits>

#include "cpu_reference/raster/clip.h"
#include "cpu_reference/raster/triangle_list.h"
#include "cpu_reference/raster/viewport.h"

namespace parity::cpu {
namespace {

/// Which planes a vertex is outside of, one bit a plane; a NaN is outside of all.
using Outcode = unsigned;

struct PlacedVertex {
  ivec2 grid{0};  ///< only where outside is 0
  Outcode outside = 0;
};

Outcode outcode(vec4 p, float guard) {
  const float reach = guard * p.w;
  return Outcode(!(p.w >= std::numeric_limits<float>::min())) | Outcode(!(p.z >= 0.0f)) << 1 |
         Outcode(!(p.z <= p.w)) << 2 | Outcode(!(p.x >= -reach)) << 3 |
         Outcode(!(p.x <= reach)) << 4 | Outcode(!(p.y >= -reach)) << 5 |
         Outcode(!(p.y <= reach)) << 6;
}

/// As many elements are worth a thread.
constexpr std::size_t chunk_size = 4096;

class SetUp {
 public:
  SetUp(const TriangleList& list, Snapping snapping, bool mirrored)
      : list_(list),
        snapping_(snapping),
        mirrored_(mirrored),
        guard_(guard_band(list.width, list.height)),
        vertices_(list.clip_positions.size()) {}

  std::vector<SnappedTriangle> run() {
    place_vertices();
    const std::size_t triangle_count = list_.triangles.size();
    std::vector<std::vector<SnappedTriangle>> chunks((triangle_count + chunk_size - 1) /
                                                     chunk_size);
#pragma omp parallel for schedule(dynamic) if (chunks.size() > 1)
    for (std::size_t c = 0; c < chunks.size(); ++c) {
      const std::size_t end = std::min(triangle_count, (c + 1) * chunk_size);
      chunks[c].reserve(end - c * chunk_size);
      for (std::size_t i = c * chunk_size; i < end; ++i) add(chunks[c], std::uint32_t(i));
    }
    std::vector<SnappedTriangle> all;
    std::size_t count = 0;
    for (const auto& chunk : chunks) count += chunk.size();
    all.reserve(count);
    for (const auto& chunk : chunks) all.insert(all.end(), chunk.begin(), chunk.end());
    return all;
  }

 private:
  void place_vertices() {
#pragma omp parallel for if (vertices_.size() > chunk_size)
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      const vec4 p = list_.clip_positions[i];
      vertices_[i].outside = outcode(p, float(guard_));
      if (vertices_[i].outside == 0) vertices_[i].grid = place(p);
    }
  }

  ivec2 place(vec4 clip) const {
    return snap(clip, list_.width, list_.height, list_.samples, snapping_);
  }

  void add(std::vector<SnappedTriangle>& to, std::uint32_t index) const {
    const uvec3 t = list_.triangles[index];
    const PlacedVertex &a = vertices_[t.x], &b = vertices_[t.y], &c = vertices_[t.z];
    if ((a.outside & b.outside & c.outside) != 0) return;
    if ((a.outside | b.outside | c.outside) == 0)
      add_piece(to, index, {a.grid, b.grid, c.grid});
    else
      add_clipped(to, index);
  }

  void add_clipped(std::vector<SnappedTriangle>& to, std::uint32_t index) const {
    const std::array<vec4, 3> corners = corners_of(list_, index);
    const ClippedPolygon polygon =
        clip_triangle({dvec4(corners[0]), dvec4(corners[1]), dvec4(corners[2])}, guard_);
    for (std::uint32_t i = 2; i < polygon.count; ++i)
      add_piece(to, index,
                {place(vec4(polygon.position[0])), place(vec4(polygon.position[i - 1])),
                 place(vec4(polygon.position[i]))});
  }

  void add_piece(std::vector<SnappedTriangle>& to, std::uint32_t index,
                 std::array<ivec2, 3> corners) const {
    const ivec2 u = corners[1] - corners[0];
    const ivec2 v = corners[2] - corners[0];
    const std::int64_t area = std::int64_t(u.x) * v.y - std::int64_t(u.y) * v.x;
    if (area == 0) return;
    const bool front = (area < 0) != mirrored_;
    if (list_.cull == (front ? Cull::front : Cull::back)) return;
    if (area < 0) std::swap(corners[1], corners[2]);
    to.push_back({corners, index, front});
  }

  const TriangleList& list_;
  Snapping snapping_;
  bool mirrored_;
  double guard_;
  std::vector<PlacedVertex> vertices_;
};

}  // namespace

double guard_band(int width, int height) { return 65536.0 / std::max({width, height, 1}); }

std::vector<SnappedTriangle> set_up(const TriangleList& list, Snapping snapping, bool mirrored) {
  check_triangles(list);
  if (list.width == 0 || list.height == 0) return {};
  return SetUp(list, snapping, mirrored).run();
}

}  // namespace parity::cpu
