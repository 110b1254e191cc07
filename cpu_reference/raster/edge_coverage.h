#pragma once

#include "geometry/raster.h"

namespace parity::cpu {

/// What covers every sample, by integer edge functions: those samples at which all three are
/// positive, or zero on a top or left edge. Traverses the bounding box of each triangle and adds an
/// increment from sample to sample.
///
/// @throws std::invalid_argument  as check_triangles.
///
/// Source: notes 1.4, 1.5; Vulkan 1.3, "Basic Polygon Rasterization".
/// Erratum: notes 1.4 add b_y - a_y to step right; with their E, E(p + (1, 0)) = E - (b_y - a_y)
/// and E(p + (0, 1)) = E + (b_x - a_x).
Coverage edge_coverage(const TriangleList& list, Snapping snapping);

/// The same with each edge function evaluated afresh at each sample.
Coverage edge_coverage_direct(const TriangleList& list, Snapping snapping);

/// The same over the whole target instead of the bounding box.
Coverage edge_coverage_brute_force(const TriangleList& list, Snapping snapping);

/// A coverage of the list's target with nothing in it.
Coverage empty_coverage(const TriangleList& list);

/// Counts one more triangle on the samples of `mask` in pixel (x, y).
inline void add_samples(Coverage& coverage, int x, int y, std::uint32_t mask,
                        std::uint32_t triangle) {
  const std::size_t first = (std::size_t(y) * std::size_t(coverage.width) + std::size_t(x)) *
                            std::size_t(coverage.samples);
  for (std::size_t s = 0; s < std::size_t(coverage.samples); ++s)
    if (mask >> s & 1) {
      ++coverage.count[first + s];
      coverage.last[first + s] = triangle + 1;
    }
}

}  // namespace parity::cpu
