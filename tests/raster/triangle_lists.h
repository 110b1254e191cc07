#pragma once

#include <cmath>
#include <random>

#include "geometry/raster.h"

/// Lists of triangles that raster tests draw.
namespace parity {

inline bool operator==(const Coverage& a, const Coverage& b) {
  return a.count == b.count && a.last == b.last;
}

inline TriangleList empty_list(int width, int height, int samples) {
  return {
      .width = width, .height = height, .samples = samples, .clip_positions = {}, .triangles = {}};
}

inline vec4 clip_at(const TriangleList& list, dvec2 window, double depth) {
  return {float(2.0 * window.x / list.width - 1.0), float(2.0 * window.y / list.height - 1.0),
          float(depth), 1.0f};
}

inline void add_triangle(TriangleList& list, vec4 a, vec4 b, vec4 c) {
  const auto first = std::uint32_t(list.clip_positions.size());
  list.clip_positions.insert(list.clip_positions.end(), {a, b, c});
  list.triangles.emplace_back(first, first + 1, first + 2);
}

inline void add_window_triangle(TriangleList& list, dvec2 a, dvec2 b, dvec2 c) {
  add_triangle(list, clip_at(list, a, 0.5), clip_at(list, b, 0.5), clip_at(list, c, 0.5));
}

/// Of all sizes and shapes: every third with corners on half pixels (exact ties), every fifth a
/// sliver.
inline TriangleList random_triangles(int width, int height, int samples, int count, unsigned seed) {
  TriangleList list = empty_list(width, height, samples);
  std::mt19937 random{seed};
  std::uniform_real_distribution<double> unit;
  for (int i = 0; i < count; ++i) {
    const dvec2 center{unit(random) * width, unit(random) * height};
    const double size = std::exp2(6.0 * unit(random) - 1.0);
    dvec2 p[3];
    for (dvec2& corner : p) corner = center + size * (dvec2(unit(random), unit(random)) - 0.5);
    if (i % 5 == 0) p[2] = 0.5 * (p[0] + p[1]) + 0.01 * (p[2] - p[0]);
    if (i % 3 == 0)
      for (dvec2& corner : p) corner = glm::round(corner * 2.0) / 2.0;
    add_window_triangle(list, p[0], p[1], p[2]);
  }
  return list;
}

/// A grid of cells, two triangles each with random diagonals, its inner points moved at random: on
/// the lattice of half pixels if `ties`. Larger than the target by a margin.
inline TriangleList watertight_mesh(int width, int height, int samples, int cells, bool ties) {
  TriangleList list = empty_list(width, height, samples);
  std::mt19937 random{unsigned(cells)};
  std::uniform_real_distribution<double> unit;
  const int n = cells + 1;
  const double margin = 3.0;
  const dvec2 cell = (dvec2(width, height) + 2.0 * margin) / double(cells);
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      dvec2 p = dvec2(x, y) * cell - margin;
      if (x > 0 && x < cells && y > 0 && y < cells)
        p += cell * 0.45 * (dvec2(unit(random), unit(random)) - 0.5);
      if (ties) p = glm::round(p * 2.0) / 2.0;
      list.clip_positions.push_back(clip_at(list, p, 0.5));
    }
  for (int y = 0; y < cells; ++y)
    for (int x = 0; x < cells; ++x) {
      const auto a = std::uint32_t(y * n + x), b = a + 1, d = a + std::uint32_t(n), c = d + 1;
      if (unit(random) < 0.5) {
        list.triangles.emplace_back(a, b, c);
        list.triangles.emplace_back(a, c, d);
      } else {
        list.triangles.emplace_back(a, b, d);
        list.triangles.emplace_back(b, c, d);
      }
    }
  return list;
}

inline std::size_t samples_not_covered_once(const Coverage& coverage) {
  std::size_t wrong = 0;
  for (const std::uint32_t count : coverage.count) wrong += count != 1;
  return wrong;
}

}  // namespace parity
