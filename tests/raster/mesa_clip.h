#pragma once

#include <array>
#include <vector>

#include "cpu_reference/raster/edge_coverage.h"
#include "cpu_reference/raster/rasterize.h"
#include "geometry/raster.h"

/// What Mesa's software rasteriser makes of triangles that leave the view volume, as
/// docs/drivers.md states it: cut at the viewport in float, new corners placed without fused
/// operations.
namespace parity::raster_test {

struct MesaCorner {
  vec4 clip{0.0f};
  bool is_new = false;
};

/// Distances from right, left, bottom, top, near, far: the order in which it cuts.
inline std::array<float, 6> mesa_distances(vec4 p) {
  return {-p.x + p.w, p.x + p.w, -p.y + p.w, p.y + p.w, p.z, -p.z + p.w};
}

/// The corner on an edge that crosses a plane, computed from the end that is nearer to it.
inline MesaCorner mesa_crossing(vec4 a, float da, vec4 b, float db) {
  if (std::abs(db) < std::abs(da)) return {b + (db / (db - da)) * (a - b), true};
  return {a + (da / (da - db)) * (b - a), true};
}

inline std::vector<MesaCorner> mesa_clip(std::vector<MesaCorner> polygon) {
  for (std::size_t plane = 0; plane < 6; ++plane) {
    std::vector<MesaCorner> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const MesaCorner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const float da = mesa_distances(a.clip)[plane], db = mesa_distances(b.clip)[plane];
      if (da >= 0) kept.push_back(a);
      if ((da < 0) != (db < 0)) kept.push_back(mesa_crossing(a.clip, da, b.clip, db));
    }
    polygon = kept;
  }
  return polygon;
}

inline ivec2 mesa_snap(const MesaCorner& corner, const TriangleList& list) {
  if (!corner.is_new)
    return cpu::snap(corner.clip, list.width, list.height, list.samples, Snapping::mesa);
  const vec2 half = 0.5f * vec2(list.width, list.height);
  const vec2 window = vec2(corner.clip) * (1.0f / corner.clip.w) * half + half;
  const vec2 steps = (window - (list.samples == 1 ? 0.5f : 0.0f)) * 256.0f;
  return {int(std::nearbyint(steps.x)), int(std::nearbyint(steps.y))};
}

/// Coverage of the pieces by the reference's edge functions.
inline Coverage mesa_coverage(const TriangleList& list) {
  const cpu::SampleGrid grid = cpu::sample_grid(list.samples, Snapping::mesa);
  Coverage coverage = cpu::empty_coverage(list);
  for (std::uint32_t t = 0; t < list.triangles.size(); ++t) {
    std::vector<MesaCorner> corners;
    for (int i = 0; i < 3; ++i) corners.push_back({list.clip_positions[list.triangles[t][i]]});
    const std::vector<MesaCorner> polygon = mesa_clip(corners);
    for (std::size_t i = 2; i < polygon.size(); ++i) {
      cpu::SnappedTriangle piece{{mesa_snap(polygon[0], list), mesa_snap(polygon[i - 1], list),
                                  mesa_snap(polygon[i], list)},
                                 t};
      const ivec2 u = piece.corners[1] - piece.corners[0], v = piece.corners[2] - piece.corners[0];
      const std::int64_t area = std::int64_t(u.x) * v.y - std::int64_t(u.y) * v.x;
      if (area == 0) continue;
      if (area < 0) std::swap(piece.corners[1], piece.corners[2]);
      cpu::rasterize_triangle(
          piece, grid, {0, 0, list.width, list.height},
          [&](int x, int y, std::uint32_t mask) { cpu::add_samples(coverage, x, y, mask, t); });
    }
  }
  return coverage;
}

}  // namespace parity::raster_test
