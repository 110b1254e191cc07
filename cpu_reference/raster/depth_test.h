#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "cpu_reference/raster/planes.h"
#include "geometry/frame.h"

namespace parity::cpu {

/// The depth buffer's convention.
struct DepthTest {
  DepthMode mode = DepthMode::reverse_z;
  double near = 0.1;
  double far = 0.0;

  float cleared() const { return mode == DepthMode::reverse_z ? 0.0f : 1.0f; }
  bool passes(float depth, float stored) const {
    return mode == DepthMode::reverse_z ? depth > stored : depth < stored;
  }
  /// Smaller is nearer in every mode.
  double distance(double depth) const { return mode == DepthMode::reverse_z ? -depth : depth; }
};

/// Depths of an element at the samples of a pixel.
///
/// Source: Vulkan 1.3, "Basic Polygon Rasterization"; notes 1.6. Logarithmic depth is written by
/// the fragment, so it is that of the pixel's centre at every sample.
class ElementDepth {
 public:
  ElementDepth(const Planes& planes, const DepthTest& test)
      : plane_(test.mode == DepthMode::logarithmic ? planes.one_over_w : planes.depth),
        logarithmic_(test.mode == DepthMode::logarithmic),
        near_(test.near),
        scale_(logarithmic_ ? 1 / std::log2(test.far / test.near) : 0) {}

  /// Depth at a point of the window; pixel (x, y) holds it.
  float operator()(int x, int y, dvec2 place) const {
    if (logarithmic_) return logarithmic(at(plane_, x + 0.5, y + 0.5));
    return float(std::clamp(at(plane_, x + place.x, y + place.y), 0.0, 1.0));
  }

 private:
  float logarithmic(double one_over_w) const {
    if (!(one_over_w > 0)) return 1.0f;
    return float(std::clamp(-std::log2(one_over_w * near_) * scale_, 0.0, 1.0));
  }

  dvec3 plane_;
  bool logarithmic_;
  double near_;
  double scale_;
};

}  // namespace parity::cpu
