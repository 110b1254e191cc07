#include <algorithm>
#include <cmath>
#include <numbers>

#include "cpu_reference/raster/clip.h"
#include "cpu_reference/raster/surface_bound.h"

namespace parity::cpu {
namespace {

constexpr double half_ulp = 0x1p-24;

bool crosses_view(const std::array<vec4, 3>& clip) {
  return std::any_of(clip.begin(), clip.end(), [](const vec4& p) {
    return !(std::abs(p.x) <= p.w && std::abs(p.y) <= p.w && p.z >= 0 && p.z <= p.w);
  });
}

/// Whether a point lies in a triangle or at most so far outside of it.
bool reaches(const std::array<dvec2, 3>& corners, dvec2 p, double outside) {
  const dvec2 u = corners[1] - corners[0], v = corners[2] - corners[0];
  const double sign = u.x * v.y - u.y * v.x < 0 ? -1 : 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const dvec2 a = corners[i], edge = corners[(i + 1) % 3] - a;
    const dvec2 low = glm::min(a, a + edge) - outside, high = glm::max(a, a + edge) + outside;
    const double side = sign * (edge.x * (p.y - a.y) - edge.y * (p.x - a.x));
    if (side < -outside * glm::length(edge)) return false;
    if (side < 0 && (glm::any(glm::lessThan(p, low)) || glm::any(glm::greaterThan(p, high))))
      return false;
  }
  return true;
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
  if (draw.primitive->topology == Topology::lines && frame.options.samples > 1)
    shift_ = limits.multisampled_line_shift;
  reach_ = frame.options.samples > 1 ? 1 : 2 * snap_;
  for (std::size_t i = 0; i < 3; ++i) {
    w_[i] = clip[i].w;
    z_[i] = clip[i].z;
  }
  if (draw.primitive->topology != Topology::triangles) return;
  if (!clipped_) {
    std::array<dvec2, 3> window;
    for (std::size_t i = 0; i < 3; ++i)
      window[i] = window_of(dvec4(clip[i]), frame.options.width, frame.options.height);
    whole_ = slenderness_of(window);
    return;
  }
  double largest = 0;
  for (const vec4& c : clip)
    largest = std::max({largest, std::abs(double(c.x)), std::abs(double(c.y)), double(c.w)});
  clip_error_ = 4 * half_ulp * largest;
  add_parts(clip);
}

ElementError::Slenderness ElementError::slenderness_of(const std::array<dvec2, 3>& p) {
  const double longest =
      std::max({glm::distance(p[0], p[1]), glm::distance(p[1], p[2]), glm::distance(p[2], p[0])});
  const dvec2 u = p[1] - p[0], v = p[2] - p[0];
  const double area = std::max(std::abs(u.x * v.y - u.y * v.x), 1e-300);
  return {longest * longest / area, longest / area};
}

/// Every edge of the clipped polygon with every other corner: whichever fan a device makes of it,
/// its triangles are among these. Those below the ratio that `slenderness` starts from are left
/// out.
void ElementError::add_parts(const std::array<vec4, 3>& clip) {
  const ClippedPolygon polygon =
      clip_triangle({dvec4(clip[0]), dvec4(clip[1]), dvec4(clip[2])}, 1.0);
  whole_ = {10, 10 / std::hypot(width_, height_)};
  const auto corner = [&](std::uint32_t i) {
    return window_of(polygon.position[i % polygon.count], int(width_), int(height_));
  };
  for (std::uint32_t edge = 0; edge < polygon.count; ++edge)
    for (std::uint32_t apex = 2; apex < polygon.count; ++apex) {
      Part part{{corner(edge), corner(edge + 1), corner(edge + apex)}, {}};
      part.slenderness = slenderness_of(part.corners);
      if (part.slenderness.ratio > whole_.ratio) parts_.push_back(part);
    }
}

ElementError::Slenderness ElementError::slenderness(double x, double y) const {
  Slenderness worst = whole_;
  for (const Part& part : parts_)
    if (part.slenderness.ratio > worst.ratio && reaches(part.corners, {x, y}, reach_))
      worst = {part.slenderness.ratio, std::max(worst.per_pixel, part.slenderness.per_pixel)};
  return worst;
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

/// Largest sum of a plane's terms in the window.
double ElementError::over_window(const dvec3& plane) const {
  return std::abs(plane.z) + std::abs(plane.x) * width_ + std::abs(plane.y) * height_;
}

double ElementError::rounding(const dvec3& plane, double largest, double slenderness) const {
  const double everywhere = over_window(plane);
  const double vertices = clipped_ ? everywhere : largest;
  return half_ulp * (8 * std::max(everywhere, largest) + 4 * vertices * slenderness);
}

double ElementError::moved(double x, double y) const {
  if (clipped_) return edge(x, y) - snap_ + shift_;
  double spread = 0;
  for (std::size_t i = 0; i < 3; ++i) spread += std::abs(at(planes_.weight[i], x, y) * w_[i]);
  return snap_ * std::max(1.0, spread) + shift_;
}

double ElementError::edge(double x, double y) const {
  const double one_over_w = std::abs(at(planes_.one_over_w, x, y));
  return 2 * snap_ + clip_error_ * one_over_w * std::max(width_, height_);
}

double ElementError::varying(const std::array<double, 3>& values, int x, int y) const {
  const double px = x + 0.5, py = y + 0.5;
  const dvec3 n = plane_of(values);
  const dvec3& d = planes_.one_over_w;
  const double divisor = at(d, px, py);
  const double a = at(n, px, py) / divisor;
  const double gradient = gradient_length(n - d * a) / std::abs(divisor);
  const double slender = slenderness(px, py).ratio;
  const double divisor_error = rounding(d, largest_over_w({1.0, 1.0, 1.0}), slender);
  const double least_divisor = std::abs(divisor) - divisor_error;
  if (!(least_divisor > 0)) return std::numeric_limits<double>::infinity();
  const double largest = std::max({std::abs(values[0]), std::abs(values[1]), std::abs(values[2])});
  return gradient * moved(px, py) +
         (rounding(n, largest_over_w(values), slender) + std::abs(a) * divisor_error) /
             least_divisor +
         22 * half_ulp * std::abs(a) + clip_error_ * 2 * largest * std::abs(divisor);
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
  const double per_pixel = slenderness(px, py).per_pixel;
  const auto evaluation = [&](const dvec3& plane, double largest) {
    const double vertices = clipped_ ? over_window(plane) : largest;
    const double sum = std::abs(plane.z) + std::abs(plane.x) * qx + std::abs(plane.y) * qy;
    return half_ulp * (6 * sum + 4 * vertices * per_pixel);
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
    const double px = x + place.x, py = y + place.y;
    return gradient_length(z) * moved(px, py) +
           rounding(z, largest_over_w(z_), slenderness(px, py).ratio) + half_ulp +
           clip_error_ * std::abs(at(planes_.one_over_w, px, py)) * (1 + std::abs(at(z, px, py)));
  }
  const dvec3& d = planes_.one_over_w;
  const double one_over_w = at(d, x + 0.5, y + 0.5);
  if (!(one_over_w > 0)) return 1;
  const double relative =
      (gradient_length(d) * moved(x + 0.5, y + 0.5) +
       rounding(d, largest_over_w({1.0, 1.0, 1.0}), slenderness(x + 0.5, y + 0.5).ratio)) /
          one_over_w +
      6 * half_ulp + clip_error_ * one_over_w;
  const double octaves = std::log2(test.far / test.near);
  const double log_error = 0x1p-21 + 6 * half_ulp * std::abs(std::log2(one_over_w * test.near));
  // The quotient of two logarithms, each with its error; the quotient is at most 1.
  return (relative / std::numbers::ln2 + 2 * log_error) / octaves + 6 * half_ulp;
}

}  // namespace parity::cpu
