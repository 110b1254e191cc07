#include "cpu_reference/raster/depth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "cpu_reference/raster/affine_bound.h"
#include "cpu_reference/raster/interpolate.h"
#include "cpu_reference/raster/rasterize.h"
#include "cpu_reference/raster/triangle_list.h"

namespace parity::cpu {
namespace {

void check_range(DepthMode mode, double near, double far) {
  if (!(near > 0.0) || !(far > near) || (mode == DepthMode::logarithmic && std::isinf(far)))
    throw std::invalid_argument("cpu::depth: near is " + std::to_string(near) + ", far is " +
                                std::to_string(far) +
                                ", must be 0 < near < far, and far finite if logarithmic");
}

/// Depth = offset + slope / distance, of the two modes that are affine in 1 / distance.
struct Hyperbola {
  double offset;
  double slope;
};

Hyperbola hyperbola(DepthMode mode, double near, double far) {
  const double slope = std::isinf(far) ? near : near * far / (far - near);
  if (mode == DepthMode::reverse_z) return {std::isinf(far) ? 0.0 : -near / (far - near), slope};
  return {std::isinf(far) ? 1.0 : far / (far - near), -slope};
}

/// |d depth / d distance|
double depth_slope(DepthMode mode, double near, double far, double distance) {
  if (mode == DepthMode::logarithmic) return 1.0 / (distance * std::log(far / near));
  return std::abs(hyperbola(mode, near, far).slope) / (distance * distance);
}

void check_list(const TriangleList& list, DepthMode mode, double near, double far) {
  check_triangles(list);
  if (list.samples != 1)
    throw std::invalid_argument("cpu::depth_test: samples is " + std::to_string(list.samples) +
                                ", must be 1");
  if (mode == DepthMode::logarithmic) check_range(mode, near, far);
}

float fragment_depth(const TrianglePlanes& planes, DepthMode mode, double near, double far,
                     double x, double y) {
  const double depth = mode == DepthMode::logarithmic
                           ? depth_value(mode, near, far, 1.0 / planes.reciprocal_w.at(x, y))
                           : planes.depth.at(x, y);
  return float(std::clamp(depth, 0.0, 1.0));
}

}  // namespace

double depth_value(DepthMode mode, double near, double far, double distance) {
  check_range(mode, near, far);
  if (mode == DepthMode::logarithmic) return std::log2(distance / near) / std::log2(far / near);
  const Hyperbola h = hyperbola(mode, near, far);
  return h.offset + h.slope / distance;
}

double depth_distance(DepthMode mode, double near, double far, double depth) {
  check_range(mode, near, far);
  if (mode == DepthMode::logarithmic) return near * std::exp2(depth * std::log2(far / near));
  const Hyperbola h = hyperbola(mode, near, far);
  return h.slope / (depth - h.offset);
}

double depth_step(DepthMode mode, double near, double far, double distance) {
  const double depth = depth_value(mode, near, far, distance);
  const int exponent = std::max(std::ilogb(depth), std::numeric_limits<float>::min_exponent - 1);
  return std::ldexp(1.0, exponent - 23) / depth_slope(mode, near, far, distance);
}

double depth_step_measured(DepthMode mode, double near, double far, double distance) {
  const double depth = depth_value(mode, near, far, distance);
  float above = std::min(float(depth), 1.0f);
  if (double(above) <= depth && above < 1.0f) above = std::nextafter(above, 2.0f);
  const float below = std::nextafter(above, -1.0f);
  return std::abs(depth_distance(mode, near, far, double(above)) -
                  depth_distance(mode, near, far, double(below)));
}

DepthImage depth_test(const TriangleList& list, DepthMode mode, double near, double far,
                      Snapping snapping) {
  check_list(list, mode, near, far);
  const bool greater = mode == DepthMode::reverse_z;
  DepthImage image{{list.width, list.height, greater ? 0.0f : 1.0f}, {list.width, list.height, 0u}};
  const SampleGrid grid = sample_grid(1, snapping);
  rasterize(set_up(list, snapping, false), grid, list.width, list.height,
            [&](const SnappedTriangle& triangle, PixelBox band) {
              const TrianglePlanes planes =
                  triangle_planes(corners_of(list, triangle.triangle), list.width, list.height);
              rasterize_triangle(triangle, grid, band, [&](int x, int y, std::uint32_t) {
                const float depth = fragment_depth(planes, mode, near, far, x + 0.5, y + 0.5);
                float& there = image.depth(x, y);
                if (greater ? !(depth > there) : !(depth < there)) return;
                there = depth;
                image.front(x, y) = triangle.triangle + 1;
              });
            });
  return image;
}

Grid<double> depth_bound(const TriangleList& list, const Grid<std::uint32_t>& front, DepthMode mode,
                         dvec2 near_far, Snapping snapping) {
  Grid<double> bounds{list.width, list.height, std::numeric_limits<double>::quiet_NaN()};
  for (int y = 0; y < list.height; ++y)
    for (int x = 0; x < list.width; ++x) {
      if (front(x, y) == 0) continue;
      const std::array<vec4, 3> clip = corners_of(list, front(x, y) - 1);
      const TrianglePlanes planes = triangle_planes(clip, list.width, list.height);
      const AffineBound bound{clip, list.width, list.height, snapping};
      const dvec3 w{clip[0].w, clip[1].w, clip[2].w};
      if (mode != DepthMode::logarithmic) {
        bounds(x, y) = bound(planes.depth, dvec3(clip[0].z, clip[1].z, clip[2].z) / w);
        continue;
      }
      const double reciprocal_w = std::abs(planes.reciprocal_w.at(x + 0.5, y + 0.5));
      const double relative = bound(planes.reciprocal_w, 1.0 / w) / reciprocal_w + 8.0 * 0x1p-23;
      const double log_of_distance = std::abs(std::log2(1.0 / (reciprocal_w * near_far.x)));
      bounds(x, y) = (relative / std::log(2.0) + 0x1p-21 + 3.0 * 0x1p-23 * log_of_distance) /
                         std::log2(near_far.y / near_far.x) +
                     8.0 * 0x1p-23;
    }
  return bounds;
}

}  // namespace parity::cpu
