#include "cpu_reference/raster/edge_coverage.h"

#include "cpu_reference/raster/rasterize.h"

namespace parity::cpu {
namespace {

PixelBox whole(const TriangleList& list) { return {0, 0, list.width, list.height}; }

bool is_inside(const std::array<std::int64_t, 3>& e) { return (e[0] | e[1] | e[2]) >= 0; }

/// Adds the samples numbered s of a box, from edge values that step from pixel to pixel.
void add_incrementally(Coverage& coverage, const SnappedTriangle& triangle, const SampleGrid& grid,
                       PixelBox box, std::size_t s) {
  const std::array<EdgeFunction, 3> edges = edge_functions(triangle);
  std::array<std::int64_t, 3> row;
  for (std::size_t i = 0; i < 3; ++i)
    row[i] = edges[i].at(std::int64_t(box.left) * grid.steps + grid.places[s].x,
                         std::int64_t(box.top) * grid.steps + grid.places[s].y);
  for (int y = box.top; y < box.bottom; ++y) {
    std::array<std::int64_t, 3> e = row;
    for (int x = box.left; x < box.right; ++x) {
      if (is_inside(e)) add_samples(coverage, x, y, 1u << s, triangle.triangle);
      for (std::size_t i = 0; i < 3; ++i) e[i] += edges[i].dx * grid.steps;
    }
    for (std::size_t i = 0; i < 3; ++i) row[i] += edges[i].dy * grid.steps;
  }
}

void add_directly(Coverage& coverage, const SnappedTriangle& triangle, const SampleGrid& grid,
                  PixelBox box) {
  const std::array<EdgeFunction, 3> edges = edge_functions(triangle);
  for (int y = box.top; y < box.bottom; ++y)
    for (int x = box.left; x < box.right; ++x)
      for (std::size_t s = 0; s < grid.places.size(); ++s) {
        const std::int64_t px = std::int64_t(x) * grid.steps + grid.places[s].x;
        const std::int64_t py = std::int64_t(y) * grid.steps + grid.places[s].y;
        if (is_inside({edges[0].at(px, py), edges[1].at(px, py), edges[2].at(px, py)}))
          add_samples(coverage, x, y, 1u << s, triangle.triangle);
      }
}

}  // namespace

Coverage empty_coverage(const TriangleList& list) {
  const std::size_t samples =
      std::size_t(list.width) * std::size_t(list.height) * std::size_t(list.samples);
  return {list.width, list.height, list.samples, std::vector<std::uint32_t>(samples),
          std::vector<std::uint32_t>(samples)};
}

Coverage edge_coverage(const TriangleList& list, Snapping snapping) {
  const std::vector<SnappedTriangle> triangles = set_up(list, snapping, false);
  const SampleGrid grid = sample_grid(list.samples, snapping);
  Coverage coverage = empty_coverage(list);
  for (const SnappedTriangle& triangle : triangles) {
    const PixelBox box = pixel_box(triangle, grid, whole(list));
    for (std::size_t s = 0; s < grid.places.size(); ++s)
      add_incrementally(coverage, triangle, grid, box, s);
  }
  return coverage;
}

Coverage edge_coverage_direct(const TriangleList& list, Snapping snapping) {
  const std::vector<SnappedTriangle> triangles = set_up(list, snapping, false);
  const SampleGrid grid = sample_grid(list.samples, snapping);
  Coverage coverage = empty_coverage(list);
  for (const SnappedTriangle& triangle : triangles)
    add_directly(coverage, triangle, grid, pixel_box(triangle, grid, whole(list)));
  return coverage;
}

Coverage edge_coverage_brute_force(const TriangleList& list, Snapping snapping) {
  const std::vector<SnappedTriangle> triangles = set_up(list, snapping, false);
  const SampleGrid grid = sample_grid(list.samples, snapping);
  Coverage coverage = empty_coverage(list);
  for (const SnappedTriangle& triangle : triangles)
    add_directly(coverage, triangle, grid, whole(list));
  return coverage;
}

}  // namespace parity::cpu
