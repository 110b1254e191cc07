#pragma once

#include <vector>

#include "geometry/raster.h"
#include "tests/raster/triangles.h"

namespace parity::raster_test {

/// Which samples a device may decide otherwise than the reference, and which not.
///
/// A device whose snapping is known must agree on triangles inside the view volume. One that is
/// cut, at the near plane or because a device cuts at the border of its viewport, gets new corners
/// that are rounded to the grid once more: both borders are then within half a step, sqrt2
/// 2^-(b+1), and a few roundings of the true one, so the samples between them are, too.
///
/// Source: Vulkan 1.3, "Primitive Clipping", "Basic Polygon Rasterization".
class CoverageRule {
 public:
  explicit CoverageRule(const RasterProblem& problem);

  /// Samples that two coverages disagree on and that no border in doubt passes near.
  std::size_t wrong_samples(const Coverage& got, const Coverage& want) const;

 private:
  /// What is inside where it is positive: affine in the window, in pixels.
  struct Side {
    dvec3 distance{0.0};
    double reach = 0;  ///< how far off the border may be
  };
  /// A triangle that a device may cover otherwise.
  struct Doubt {
    std::uint32_t triangle = 0;
    std::vector<Side> sides;
    bool at(dvec2 place) const;
  };

  void add(const RasterProblem& problem, std::uint32_t triangle);
  bool may_differ(dvec2 place, std::size_t sample, const Coverage& got, const Coverage& want) const;

  std::vector<Doubt> doubts_;
};

/// Samples that a coverage of this problem is wrong about.
double wrong_samples(const RasterProblem& problem, const Coverage& got, const Coverage& want);

}  // namespace parity::raster_test
