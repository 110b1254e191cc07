#include <algorithm>
#include <cmath>
#include <numbers>

#include "cpu_reference/raster/surface_bound.h"

namespace parity::cpu {
namespace {

constexpr double half_ulp = 0x1p-24;

bool crosses_view(const std::array<vec4, 3>& clip) {
  return std::any_of(clip.begin(), clip.end(), [](const vec4& p) {
    return !(std::abs(p.x) <= p.w && std::abs(p.y) <= p.w && p.z >= 0 && p.z <= p.w);
  });
}

double gradient_length(const dvec3& plane) { return std::hypot(plane.x, plane.y); }

}  // namespace

ElementError::ElementError(const PlacedDraw& draw, std::uint32_t element, const Planes& planes,
                           const Frame& frame, const DeviceLimits& limits)
    : planes_(planes), width_(frame.options.width), height_(frame.options.height) {
  const std::array<vec4, 3> clip = clip_corners(draw, element);
  clipped_ = crosses_view(clip);
  const double side = std::max(width_, height_);
  // Half a step of the grid, and the float of the window position itself: divide, scale, add.
  snap_ = std::numbers::sqrt2 * (std::exp2(-limits.sub_pixel_bits - 1) + 1.5 * 2 * half_ulp * side);
  double longest = std::hypot(width_, height_), area = longest;
  bool in_front = true;
  for (std::size_t i = 0; i < 3; ++i) {
    w_[i] = clip[i].w;
    z_[i] = clip[i].z;
    in_front &= clip[i].w > 0;
  }
  if (in_front && !clipped_ && draw.primitive->topology == Topology::triangles) {
    std::array<dvec2, 3> p;
    for (std::size_t i = 0; i < 3; ++i)
      p[i] = window_of(dvec4(clip[i]), frame.options.width, frame.options.height);
    longest =
        std::max({glm::distance(p[0], p[1]), glm::distance(p[1], p[2]), glm::distance(p[2], p[0])});
    const dvec2 u = p[1] - p[0], v = p[2] - p[0];
    area = std::max(std::abs(u.x * v.y - u.y * v.x), 1e-300);
  }
  slenderness_ = longest * longest / area;
  per_pixel_ = longest / area;
  if (!clipped_) return;
  // Parts of a clipped triangle are judged as if their height were a tenth of their length: what
  // is slimmer covers hardly a pixel beside the border, which is in doubt anyway.
  slenderness_ = 10;
  per_pixel_ = 10 / longest;
  double largest = 0;
  for (const vec4& c : clip)
    largest = std::max({largest, std::abs(double(c.x)), std::abs(double(c.y)), double(c.w)});
  clip_error_ = 4 * half_ulp * largest * side;
}

dvec3 ElementError::plane_of(const std::array<double, 3>& values) const {
  return planes_.weight[0] * values[0] + planes_.weight[1] * values[1] +
         planes_.weight[2] * values[2];
}

double ElementError::largest_over_w(const std::array<double, 3>& values) const {
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i)
    if (w_[i] > 0 && !clipped_) largest = std::max(largest, std::abs(values[i] / w_[i]));
  return largest;
}

double ElementError::rounding(const dvec3& plane, double largest) const {
  const double over_window =
      std::abs(plane.z) + std::abs(plane.x) * width_ + std::abs(plane.y) * height_;
  const double vertices = clipped_ ? over_window : largest;
  return half_ulp * (8 * std::max(over_window, largest) + 4 * vertices * slenderness_);
}

double ElementError::moved(double x, double y) const {
  if (clipped_) return snap_ + clip_error_ * std::abs(at(planes_.one_over_w, x, y));
  double spread = 0;
  for (std::size_t i = 0; i < 3; ++i) spread += std::abs(at(planes_.weight[i], x, y) * w_[i]);
  return snap_ * std::max(1.0, spread);
}

double ElementError::edge(double x, double y) const {
  return 2 * snap_ + (clipped_ ? clip_error_ * std::abs(at(planes_.one_over_w, x, y)) : 0.0);
}

double ElementError::varying(const std::array<double, 3>& values, int x, int y) const {
  const double px = x + 0.5, py = y + 0.5;
  const dvec3 n = plane_of(values);
  const dvec3& d = planes_.one_over_w;
  const double divisor = at(d, px, py);
  const double a = at(n, px, py) / divisor;
  const double gradient = gradient_length(n - d * a) / std::abs(divisor);
  const double divisor_error = rounding(d, largest_over_w({1.0, 1.0, 1.0}));
  const double least_divisor = std::abs(divisor) - divisor_error;
  if (!(least_divisor > 0)) return std::numeric_limits<double>::infinity();
  return gradient * moved(px, py) +
         (rounding(n, largest_over_w(values)) + std::abs(a) * divisor_error) / least_divisor +
         22 * half_ulp * std::abs(a);
}

double ElementError::difference(const std::array<double, 3>& values, int x, int y,
                                ivec2 step) const {
  const double px = x + 0.5, py = y + 0.5, qx = px + step.x, qy = py + step.y;
  const dvec3 n = plane_of(values);
  const dvec3& d = planes_.one_over_w;
  const double divisor = std::abs(at(d, px, py)), other = std::abs(at(d, qx, qy));
  if (!(divisor > 0) || !(other > 0)) return std::numeric_limits<double>::infinity();
  const double a = at(n, px, py) / at(d, px, py), b = at(n, qx, qy) / at(d, qx, qy);
  const dvec3 at_p = (n - d * a) / at(d, px, py), at_q = (n - d * b) / at(d, qx, qy);
  double turned = 0;  // how much the sum of moved vertices changes over the step
  if (!clipped_)
    for (std::size_t i = 0; i < 3; ++i)
      turned += std::abs((planes_.weight[i].x * step.x + planes_.weight[i].y * step.y) * w_[i]);
  // The origin's value is common to both; products and sums round at each pixel alone, and the
  // error of the slopes acts over one pixel.
  const auto evaluation = [&](const dvec3& plane, double largest) {
    const double sum = std::abs(plane.z) + std::abs(plane.x) * qx + std::abs(plane.y) * qy;
    return half_ulp * (6 * sum + 4 * largest * per_pixel_);
  };
  const double float_error =
      (evaluation(n, largest_over_w(values)) +
       std::max(std::abs(a), std::abs(b)) * evaluation(d, largest_over_w({1.0, 1.0, 1.0}))) /
      std::min(divisor, other);
  return std::hypot(at_q.x - at_p.x, at_q.y - at_p.y) * moved(px, py) +
         gradient_length(at_q) * snap_ * turned + float_error +
         6 * half_ulp * (std::abs(a) + std::abs(b));
}

double ElementError::depth(int x, int y, dvec2 place, const DepthTest& test) const {
  if (test.mode != DepthMode::logarithmic) {
    const dvec3& z = planes_.depth;
    return gradient_length(z) * moved(x + place.x, y + place.y) + rounding(z, largest_over_w(z_)) +
           half_ulp;
  }
  const dvec3& d = planes_.one_over_w;
  const double one_over_w = at(d, x + 0.5, y + 0.5);
  if (!(one_over_w > 0)) return 1;
  const double relative = (gradient_length(d) * moved(x + 0.5, y + 0.5) +
                           rounding(d, largest_over_w({1.0, 1.0, 1.0}))) /
                              one_over_w +
                          6 * half_ulp;
  const double octaves = std::log2(test.far / test.near);
  const double log_error = 0x1p-21 + 6 * half_ulp * std::abs(std::log2(one_over_w * test.near));
  // The quotient of two logarithms, each with its error; the quotient is at most 1.
  return (relative / std::numbers::ln2 + 2 * log_error) / octaves + 6 * half_ulp;
}

}  // namespace parity::cpu
