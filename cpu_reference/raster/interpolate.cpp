#include "cpu_reference/raster/interpolate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include "cpu_reference/raster/affine_bound.h"
#include "cpu_reference/raster/rasterize.h"
#include "cpu_reference/raster/triangle_list.h"

namespace parity::cpu {
namespace {

/// Turns an affine function of NDC, (coefficients of x, of y, constant), into one of pixels.
WindowPlane window_plane(dvec3 ndc, int width, int height) {
  return {ndc.z - ndc.x - ndc.y, 2.0 * ndc.x / width, 2.0 * ndc.y / height};
}

WindowPlane combine(const std::array<WindowPlane, 3>& planes, dvec3 weights) {
  WindowPlane sum;
  for (int i = 0; i < 3; ++i) {
    const WindowPlane& plane = planes[std::size_t(i)];
    sum.at_origin += weights[i] * plane.at_origin;
    sum.dx += weights[i] * plane.dx;
    sum.dy += weights[i] * plane.dy;
  }
  return sum;
}

void check(const TriangleList& list, const Varyings& varyings) {
  if (list.samples != 1)
    throw std::invalid_argument("cpu::interpolate: samples is " + std::to_string(list.samples) +
                                ", must be 1");
  if (varyings.values.size() != list.clip_positions.size())
    throw std::invalid_argument("cpu::interpolate: " + std::to_string(varyings.values.size()) +
                                " values for " + std::to_string(list.clip_positions.size()) +
                                " clip positions, must be as many");
}

/// A triangle with its varyings.
struct Interpolant {
  std::array<vec4, 3> clip;
  std::array<dvec4, 3> values;
  TrianglePlanes planes;
  bool perspective;
};

Interpolant interpolant(const TriangleList& list, const Varyings& varyings, std::uint32_t index) {
  const uvec3 t = list.triangles[index];
  const std::array<vec4, 3> clip = corners_of(list, index);
  return {clip,
          {dvec4(varyings.values[t.x]), dvec4(varyings.values[t.y]), dvec4(varyings.values[t.z])},
          triangle_planes(clip, list.width, list.height),
          varyings.perspective};
}

dvec4 value_at(const Interpolant& of, double x, double y) {
  dvec3 weights = of.planes.perspective(x, y);
  if (!of.perspective)  // lambda_i = w_i (b_i / w): the corner's share in the window
    for (int i = 0; i < 3; ++i)
      weights[i] =
          of.planes.barycentric_over_w[std::size_t(i)].at(x, y) * double(of.clip[std::size_t(i)].w);
  return weights.x * of.values[0] + weights.y * of.values[1] + weights.z * of.values[2];
}

/// Numerators a / w (or a itself) and the denominator of the four components, with their bounds.
class ValueBound {
 public:
  ValueBound(const Interpolant& of, const TriangleList& list, Snapping snapping) : of_(of) {
    const AffineBound bound{of.clip, list.width, list.height, snapping};
    const dvec3 w{of.clip[0].w, of.clip[1].w, of.clip[2].w};
    denominator_error_ = bound(of.planes.reciprocal_w, 1.0 / w);
    for (int c = 0; c < 4; ++c) {
      const dvec3 values{of.values[0][c], of.values[1][c], of.values[2][c]};
      const dvec3 weights = of.perspective ? values : values * w;
      numerator_error_[c] = bound(combine(of.planes.barycentric_over_w, weights),
                                  of.perspective ? values / w : values);
    }
  }

  double at(double x, double y) const {
    if (!of_.perspective) return largest(numerator_error_);
    const double denominator = std::abs(of_.planes.reciprocal_w.at(x, y)) - denominator_error_;
    if (!(denominator > 0.0)) return std::numeric_limits<double>::infinity();
    const dvec4 value = glm::abs(value_at(of_, x, y));
    return largest((numerator_error_ + value * denominator_error_) / denominator +
                   11.0 * 0x1p-23 * value);
  }

 private:
  static double largest(dvec4 v) { return std::max({v.x, v.y, v.z, v.w}); }

  Interpolant of_;
  double denominator_error_ = 0.0;
  dvec4 numerator_error_{0.0};
};

/// For every pixel that something covers, calls visit(x, y, prepared) with what prepare(triangle)
/// makes of the last triangle that does.
template <class Prepare, class Visit>
void visit_last(const TriangleList& list, Snapping snapping, Prepare&& prepare, Visit&& visit) {
  const Coverage coverage = span_coverage(list, snapping);
  std::optional<decltype(prepare(0u))> prepared;
  std::uint32_t prepared_for = 0;
  std::size_t pixel = 0;
  for (int y = 0; y < list.height; ++y)
    for (int x = 0; x < list.width; ++x, ++pixel) {
      const std::uint32_t last = coverage.last[pixel];
      if (last == 0) continue;
      if (last != prepared_for) prepared.emplace(prepare(last - 1));
      prepared_for = last;
      visit(x, y, *prepared);
    }
}

}  // namespace

TrianglePlanes triangle_planes(const std::array<vec4, 3>& clip, int width, int height) {
  const dvec3 a{clip[0].x, clip[0].y, clip[0].w};
  const dvec3 b{clip[1].x, clip[1].y, clip[1].w};
  const dvec3 c{clip[2].x, clip[2].y, clip[2].w};
  const std::array<dvec3, 3> cofactors{glm::cross(b, c), glm::cross(c, a), glm::cross(a, b)};
  const double determinant = glm::dot(a, cofactors[0]);
  TrianglePlanes planes;
  for (std::size_t i = 0; i < 3; ++i)
    planes.barycentric_over_w[i] = determinant != 0.0
                                       ? window_plane(cofactors[i] / determinant, width, height)
                                       : WindowPlane{1.0 / (a.z + b.z + c.z), 0.0, 0.0};
  planes.reciprocal_w = combine(planes.barycentric_over_w, dvec3(1.0));
  planes.depth =
      combine(planes.barycentric_over_w, {double(clip[0].z), double(clip[1].z), double(clip[2].z)});
  return planes;
}

Grid<dvec4> interpolate(const TriangleList& list, const Varyings& varyings, Snapping snapping) {
  check(list, varyings);
  Grid<dvec4> values{list.width, list.height, dvec4(std::numeric_limits<double>::quiet_NaN())};
  visit_last(
      list, snapping, [&](std::uint32_t triangle) { return interpolant(list, varyings, triangle); },
      [&](int x, int y, const Interpolant& of) { values(x, y) = value_at(of, x + 0.5, y + 0.5); });
  return values;
}

Grid<double> interpolate_bound(const TriangleList& list, const Varyings& varyings,
                               Snapping snapping) {
  check(list, varyings);
  Grid<double> bounds{list.width, list.height, std::numeric_limits<double>::quiet_NaN()};
  visit_last(
      list, snapping,
      [&](std::uint32_t triangle) {
        return ValueBound(interpolant(list, varyings, triangle), list, snapping);
      },
      [&](int x, int y, const ValueBound& of) { bounds(x, y) = of.at(x + 0.5, y + 0.5); });
  return bounds;
}

}  // namespace parity::cpu
