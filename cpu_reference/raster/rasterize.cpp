#include "cpu_reference/raster/rasterize.h"

#include <omp.h>

#include "cpu_reference/raster/edge_coverage.h"

namespace parity::cpu {

int band_count(int height) {
  const int threads = omp_get_max_threads();
  const int smallest_band = 32;
  return threads == 1 ? 1 : std::clamp(height / smallest_band, 1, 4 * threads);
}

Coverage span_coverage(const TriangleList& list, Snapping snapping) {
  const std::vector<SnappedTriangle> triangles = set_up(list, snapping, false);
  const SampleGrid grid = sample_grid(list.samples, snapping);
  Coverage coverage = empty_coverage(list);
  rasterize(triangles, grid, list.width, list.height,
            [&](const SnappedTriangle& triangle, PixelBox band) {
              rasterize_triangle(triangle, grid, band, [&](int x, int y, std::uint32_t mask) {
                add_samples(coverage, x, y, mask, triangle.triangle);
              });
            });
  return coverage;
}

}  // namespace parity::cpu
