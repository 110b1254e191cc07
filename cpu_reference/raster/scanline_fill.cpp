#include "cpu_reference/raster/scanline_fill.h"

#include <algorithm>
#include <limits>

#include "cpu_reference/raster/edge_coverage.h"
#include "cpu_reference/raster/setup.h"
#include "cpu_reference/raster/viewport.h"

namespace parity::cpu {
namespace {

std::int64_t ceil_divide(std::int64_t numerator, std::int64_t positive) {
  return numerator / positive + std::int64_t(numerator % positive > 0);
}

/// Pixels of one row, end excluded.
struct Crossings {
  std::int64_t left = std::numeric_limits<std::int64_t>::max();
  std::int64_t right = std::numeric_limits<std::int64_t>::min();
};

/// The first pixel right of (or on) the edge a -> b in the row of samples at y, if the row meets
/// it. Pixel x has its sample at x steps + place.
void cross(Crossings& row, ivec2 a, ivec2 b, std::int64_t y, std::int64_t place,
           std::int64_t steps) {
  if (a.y > b.y) std::swap(a, b);
  if (y < a.y || y >= b.y) return;
  const std::int64_t height = std::int64_t(b.y) - a.y;
  const std::int64_t run = std::int64_t(b.x) - a.x;
  const std::int64_t pixel = ceil_divide((a.x - place) * height + (y - a.y) * run, height * steps);
  row.left = std::min(row.left, pixel);
  row.right = std::max(row.right, pixel);
}

/// Rows of pixels whose sample at height `place` lies in [lowest, highest) of the triangle.
void fill(Coverage& coverage, const SnappedTriangle& triangle, std::int64_t steps, std::size_t s,
          ivec2 place) {
  const auto& c = triangle.corners;
  const std::int64_t lowest = std::min({c[0].y, c[1].y, c[2].y});
  const std::int64_t highest = std::max({c[0].y, c[1].y, c[2].y});
  const std::int64_t top = std::max<std::int64_t>(0, ceil_divide(lowest - place.y, steps));
  const std::int64_t bottom =
      std::min<std::int64_t>(coverage.height, ceil_divide(highest - place.y, steps));
  for (std::int64_t y = top; y < bottom; ++y) {
    Crossings row;
    for (std::size_t i = 0; i < 3; ++i)
      cross(row, c[i], c[(i + 1) % 3], y * steps + place.y, place.x, steps);
    const std::int64_t left = std::max<std::int64_t>(0, row.left);
    const std::int64_t right = std::min<std::int64_t>(coverage.width, row.right);
    for (std::int64_t x = left; x < right; ++x)
      add_samples(coverage, int(x), int(y), 1u << s, triangle.triangle);
  }
}

}  // namespace

Coverage scanline_fill(const TriangleList& list, Snapping snapping) {
  const SampleGrid grid = sample_grid(list.samples, snapping);
  Coverage coverage = empty_coverage(list);
  for (const SnappedTriangle& triangle : set_up(list, snapping, false))
    for (std::size_t s = 0; s < grid.places.size(); ++s)
      fill(coverage, triangle, grid.steps, s, grid.places[s]);
  return coverage;
}

}  // namespace parity::cpu
