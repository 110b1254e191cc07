#include "cpu_reference/sampling/area_coverage.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace parity::cpu {
namespace {

using Ring = std::vector<dvec2>;

/// The part of a ring where sign p[axis] >= sign limit. Parts that fall apart stay joined along
/// the border, where they have no area.
Ring cut(const Ring& ring, int axis, double limit, double sign) {
  Ring kept;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const dvec2 a = ring[i], b = ring[(i + 1) % ring.size()];
    const double da = sign * (a[axis] - limit), db = sign * (b[axis] - limit);
    if (da >= 0) kept.push_back(a);
    if ((da < 0) != (db < 0)) {
      dvec2 p = a + (b - a) * (da / (da - db));
      p[axis] = limit;
      kept.push_back(p);
    }
  }
  return kept;
}

Ring slice(const Ring& ring, int axis, double low, double high) {
  return cut(cut(ring, axis, low, 1), axis, high, -1);
}

/// Positive for clockwise rings, y down; about the first corner, so that far rings do not cancel.
double signed_area(const Ring& ring) {
  double twice = 0;
  for (std::size_t i = 2; i < ring.size(); ++i) {
    const dvec2 a = ring[i - 1] - ring[0], b = ring[i] - ring[0];
    twice += a.x * b.y - a.y * b.x;
  }
  return twice / 2;
}

void add_ring(const Ring& ring, Grid<double>& areas) {
  for (int y = 0; y < areas.height(); ++y) {
    const Ring row = slice(ring, 1, y, y + 1);
    if (row.empty()) continue;
    double low = row[0].x, high = row[0].x;
    for (const dvec2& p : row) low = std::min(low, p.x), high = std::max(high, p.x);
    const int from = int(std::floor(std::clamp(low, 0.0, double(areas.width()))));
    const int to = int(std::ceil(std::clamp(high, 0.0, double(areas.width()))));
    for (int x = from; x < to; ++x) areas(x, y) += signed_area(slice(row, 0, x, x + 1));
  }
}

}  // namespace

Grid<double> area_coverage(const Polygon& polygon, int width, int height) {
  if (width < 1 || height < 1 || width > 16384 || height > 16384)
    throw std::invalid_argument("cpu::area_coverage: size is " + std::to_string(width) + "x" +
                                std::to_string(height) + ", sides must be 1 to 16384");
  Grid<double> areas{width, height};
  for (const std::vector<vec2>& ring : polygon.rings) {
    Ring exact;
    for (const vec2& p : ring) exact.push_back(dvec2(p));
    add_ring(exact, areas);
  }
  return areas;
}

}  // namespace parity::cpu
