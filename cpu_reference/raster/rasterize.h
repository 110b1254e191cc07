#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "cpu_reference/raster/setup.h"
#include "cpu_reference/raster/viewport.h"

/// The rasteriser that the reference's systems use: exact coverage as spans of rows.
namespace parity::cpu {

/// One edge a -> b of a triangle as the function of sample position (in steps)
/// E(p) = (b_x - a_x)(p_y - a_y) - (b_y - a_y)(p_x - a_x) + bias, which is >= 0 on the inside.
/// The bias is -1 unless the edge is a top or a left one: of the samples exactly on an edge only
/// those of top and left edges are inside.
///
/// Source: notes 1.4; the top-left rule of Direct3D, one of Vulkan's choices.
struct EdgeFunction {
  std::int64_t at_origin = 0;  ///< E(0, 0)
  std::int64_t dx = 0;         ///< E(p + (1, 0)) - E(p)
  std::int64_t dy = 0;         ///< E(p + (0, 1)) - E(p)

  std::int64_t at(std::int64_t x, std::int64_t y) const { return at_origin + x * dx + y * dy; }
};

inline EdgeFunction edge_function(ivec2 a, ivec2 b) {
  const std::int64_t x = std::int64_t(b.x) - a.x;
  const std::int64_t y = std::int64_t(b.y) - a.y;
  const bool is_top_or_left = y < 0 || (y == 0 && x > 0);
  return {.at_origin = y * a.x - x * a.y - (is_top_or_left ? 0 : 1), .dx = -y, .dy = x};
}

inline std::array<EdgeFunction, 3> edge_functions(const SnappedTriangle& triangle) {
  const auto& c = triangle.corners;
  return {edge_function(c[0], c[1]), edge_function(c[1], c[2]), edge_function(c[2], c[0])};
}

/// Rectangle of pixels, ends excluded.
struct PixelBox {
  int left = 0, top = 0, right = 0, bottom = 0;
  bool empty() const { return left >= right || top >= bottom; }
};

/// The pixels of `within` that have a sample inside the triangle's bounding box.
inline PixelBox pixel_box(const SnappedTriangle& triangle, const SampleGrid& grid,
                          PixelBox within) {
  const auto& c = triangle.corners;
  const ivec2 last = glm::max(glm::max(c[0], c[1]), c[2]) - grid.lowest;
  const ivec2 first = glm::min(glm::min(c[0], c[1]), c[2]) - grid.highest + (grid.steps - 1);
  return {std::max(within.left, first.x >> grid.step_bits),
          std::max(within.top, first.y >> grid.step_bits),
          std::min(within.right, (last.x >> grid.step_bits) + 1),
          std::min(within.bottom, (last.y >> grid.step_bits) + 1)};
}

namespace detail {

inline std::int64_t floor_divide(std::int64_t numerator, std::int64_t positive) {
  const std::int64_t quotient = numerator / positive;
  return quotient - std::int64_t(numerator % positive < 0);
}

/// Pixels of a row, end excluded.
struct Span {
  int begin = 0;
  int end = 0;
};

/// The pixels of a span whose sample is inside all edges. values: E at the sample of pixel x = 0;
/// steps: E from a pixel to the next.
inline Span inside_span(Span span, const std::array<std::int64_t, 3>& values,
                        const std::array<std::int64_t, 3>& steps) {
  std::int64_t begin = span.begin;
  std::int64_t end = span.end;
  for (std::size_t i = 0; i < 3; ++i) {
    if (steps[i] > 0)
      begin = std::max(begin, -floor_divide(values[i], steps[i]));
    else if (steps[i] < 0)
      end = std::min(end, floor_divide(values[i], -steps[i]) + 1);
    else if (values[i] < 0)
      end = span.begin;
  }
  begin = std::min(begin, std::int64_t(span.end));
  return {int(begin), int(std::max(begin, end))};
}

/// Calls visit(x, y, mask) for each pixel of a box with a sample inside the triangle.
template <int Samples, class Visit>
void visit_pixels(const SnappedTriangle& triangle, const SampleGrid& grid, PixelBox box,
                  Visit&& visit) {
  const std::array<EdgeFunction, 3> edges = edge_functions(triangle);
  std::array<std::int64_t, 3> steps;
  std::array<std::array<std::int64_t, 3>, Samples> values;
  for (std::size_t i = 0; i < 3; ++i) {
    steps[i] = edges[i].dx * grid.steps;
    for (std::size_t s = 0; s < Samples; ++s)
      values[s][i] =
          edges[i].at(grid.places[s].x, std::int64_t(box.top) * grid.steps + grid.places[s].y);
  }
  for (int y = box.top; y < box.bottom; ++y) {
    std::array<Span, Samples> spans;
    Span all{box.right, box.left};
    for (std::size_t s = 0; s < Samples; ++s) {
      spans[s] = inside_span({box.left, box.right}, values[s], steps);
      if (spans[s].begin < spans[s].end)
        all = {std::min(all.begin, spans[s].begin), std::max(all.end, spans[s].end)};
      for (std::size_t i = 0; i < 3; ++i) values[s][i] += edges[i].dy * grid.steps;
    }
    for (int x = all.begin; x < all.end; ++x) {
      if constexpr (Samples == 1) {
        visit(x, y, std::uint32_t(1));
      } else {
        std::uint32_t mask = 0;
        for (std::size_t s = 0; s < Samples; ++s)
          mask |= std::uint32_t(x >= spans[s].begin && x < spans[s].end) << s;
        if (mask != 0) visit(x, y, mask);
      }
    }
  }
}

}  // namespace detail

/// Calls visit(x, y, mask) for each pixel of `within` that has a sample inside the triangle, rows
/// from the top, pixels from the left. Bit s of the mask is sample s.
template <class Visit>
void rasterize_triangle(const SnappedTriangle& triangle, const SampleGrid& grid, PixelBox within,
                        Visit&& visit) {
  const PixelBox box = pixel_box(triangle, grid, within);
  if (box.empty()) return;
  switch (grid.places.size()) {
    case 1:
      return detail::visit_pixels<1>(triangle, grid, box, visit);
    case 2:
      return detail::visit_pixels<2>(triangle, grid, box, visit);
    case 4:
      return detail::visit_pixels<4>(triangle, grid, box, visit);
    default:
      return detail::visit_pixels<8>(triangle, grid, box, visit);
  }
}

/// How many bands of rows a target is split into, for the threads there are.
int band_count(int height);

/// Draws triangles in their order, in parallel over bands of rows: every pixel belongs to one band,
/// so the result does not depend on the number of threads.
///
/// @param draw  draw(const SnappedTriangle&, PixelBox band): called for each triangle whose rows
///              meet the band; draws what of it lies in the band, with rasterize_triangle. Must
///              touch the band's pixels only, and not throw.
template <class Draw>
void rasterize(std::span<const SnappedTriangle> triangles, const SampleGrid& grid, int width,
               int height, Draw&& draw) {
  const int bands = band_count(height);
#pragma omp parallel for schedule(dynamic) if (bands > 1)
  for (int b = 0; b < bands; ++b) {
    const PixelBox band{0, int(std::int64_t(height) * b / bands), width,
                        int(std::int64_t(height) * (b + 1) / bands)};
    for (const SnappedTriangle& triangle : triangles)
      if (!pixel_box(triangle, grid, band).empty()) draw(triangle, band);
  }
}

/// Coverage of a list through this rasteriser. Equals edge_coverage.
///
/// @throws std::invalid_argument  as check_triangles.
Coverage span_coverage(const TriangleList& list, Snapping snapping);

}  // namespace parity::cpu
