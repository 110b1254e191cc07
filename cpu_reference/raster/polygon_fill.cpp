#include "cpu_reference/raster/polygon_fill.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace parity::cpu {
namespace {

/// Edges with their lower end first; winding is +1 if the ring goes down (y grows) along it.
struct Edge {
  dvec2 low;
  dvec2 high;
  int winding;
};

std::vector<Edge> edges_of(const Polygon& polygon) {
  std::vector<Edge> edges;
  for (const std::vector<vec2>& ring : polygon.rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const dvec2 a{ring[i]};
      const dvec2 b{ring[(i + 1) % ring.size()]};
      if (!std::isfinite(a.x) || !std::isfinite(a.y))
        throw std::invalid_argument("cpu::polygon_fill: a coordinate is not finite");
      if (a.y < b.y) edges.push_back({a, b, 1});
      if (b.y < a.y) edges.push_back({b, a, -1});
    }
  return edges;
}

/// The first pixel of row y whose centre is on or right of the edge, 0 to width. The division
/// guesses; the products, exact for coordinates on a fixed-point grid, decide.
int first_pixel_right(const Edge& edge, double y, int width) {
  const dvec2 run = edge.high - edge.low;
  const auto is_right = [&](int pixel) {
    return (pixel + 0.5 - edge.low.x) * run.y >= (y - edge.low.y) * run.x;
  };
  const double crossing = edge.low.x + (y - edge.low.y) * (run.x / run.y);
  int pixel = int(std::clamp(std::ceil(crossing - 0.5), 0.0, double(width)));
  while (pixel > 0 && is_right(pixel - 1)) --pixel;
  while (pixel < width && !is_right(pixel)) ++pixel;
  return pixel;
}

}  // namespace

Grid<std::uint8_t> polygon_fill(const Polygon& polygon, FillRule rule, int width, int height) {
  const std::vector<Edge> edges = edges_of(polygon);
  Grid<std::uint8_t> filled{width, height, std::uint8_t(0)};
  std::vector<int> change(std::size_t(width) + 1);
  for (int row = 0; row < height; ++row) {
    const double y = row + 0.5;
    std::fill(change.begin(), change.end(), 0);
    for (const Edge& edge : edges)
      if (edge.low.y <= y && y < edge.high.y)
        change[std::size_t(first_pixel_right(edge, y, width))] +=
            rule == FillRule::even_odd ? 1 : edge.winding;
    int crossings = 0;
    for (int x = 0; x < width; ++x) {
      crossings += change[std::size_t(x)];
      filled(x, row) = rule == FillRule::even_odd ? crossings % 2 : crossings != 0;
    }
  }
  return filled;
}

}  // namespace parity::cpu
