#include "cpu_reference/raster/affine_bound.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace parity::cpu {

AffineBound::AffineBound(const std::array<vec4, 3>& clip, int width, int height, Snapping snapping)
    : width_(width),
      height_(height),
      snap_(std::numbers::sqrt2 * (snapping == Snapping::mesa ? 0x1p-9 : 0x1p-5)) {
  std::array<dvec2, 3> p;
  for (std::size_t i = 0; i < 3; ++i)
    p[i] = (dvec2(clip[i]) / double(clip[i].w) + 1.0) * 0.5 * dvec2(width, height);
  const dvec2 u = p[1] - p[0], v = p[2] - p[0], w = p[2] - p[1];
  const double longest = std::max({glm::dot(u, u), glm::dot(v, v), glm::dot(w, w)});
  slenderness_ = longest / std::abs(u.x * v.y - u.y * v.x);
}

double AffineBound::operator()(const WindowPlane& function, dvec3 at_corners) const {
  const double largest =
      std::max({std::abs(at_corners.x), std::abs(at_corners.y), std::abs(at_corners.z)});
  const double over_window = std::abs(function.at_origin) + std::abs(function.dx) * width_ +
                             std::abs(function.dy) * height_;
  return snap_ * std::hypot(function.dx, function.dy) +
         8.0 * 0x1p-24 * std::max(over_window, largest) + 4.0 * 0x1p-24 * largest * slenderness_;
}

}  // namespace parity::cpu
