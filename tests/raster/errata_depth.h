#pragma once

#include <cmath>
#include <functional>

#include "geometry/camera.h"
#include "geometry/math.h"

namespace parity {

/// Depth at screen-space barycentric coordinates of a triangle with depths z / w and clip w.
using DepthAt = std::function<double(dvec3 screen, dvec3 depth, dvec3 w)>;

/// Is the depth at a pixel that of the point of the triangle that is seen there? Near 1, far 100;
/// corners at distances 2, 10, 50; standard depth f / (f - n) (1 - n / z). Checklist row 5.
inline bool depth_is_that_of_the_true_point(const DepthAt& depth_at) {
  const double near = 1.0, far = 100.0;
  const auto depth = [&](double z) { return far / (far - near) * (1.0 - near / z); };
  const dvec3 z{2.0, 10.0, 50.0};
  const dvec3 screen{0.25, 0.35, 0.4};
  // The ray through the pixel meets the plane where 1 / distance is the mean of the corners'.
  const double distance = 1.0 / (screen.x / z.x + screen.y / z.y + screen.z / z.z);
  const dvec3 depths{depth(z.x), depth(z.y), depth(z.z)};
  // Implementations may hold corners as floats: a few 2^-24 of depths up to 1.
  return std::abs(depth_at(screen, depths, z) - depth(distance)) < 8.0 * 0x1p-24;
}

/// Depth of a point at a distance, for reverse-Z.
using ReverseDepth = std::function<double(double near, double far, double distance)>;

/// Is a depth fit for a reverse-Z D32F buffer: 1 at near, 0 at far, falling; and are steps at
/// 1000 m and 50 km below a centimetre, where the standard buffer has .6 m and 1.5 km? Near 0.1 m,
/// far 100 km. Checklist row 14.
inline bool reverse_z_mends_the_far_field(const ReverseDepth& depth) {
  const double near = 0.1, far = 1e5;
  const auto step = [&](double distance) {
    const float here = float(depth(near, far, distance));
    const double slope =
        (depth(near, far, distance * (1.0 + 1e-6)) - depth(near, far, distance * (1.0 - 1e-6))) /
        (2e-6 * distance);
    return double(std::nextafter(here, 2.0f) - here) / std::abs(slope);
  };
  const double rounding = 1e-15;  // of differences of numbers up to 1, some roundings
  return std::abs(depth(near, far, near) - 1.0) < rounding &&
         std::abs(depth(near, far, far)) < rounding &&
         depth(near, far, 1.0) > depth(near, far, 2.0) && step(1000.0) < 0.01 && step(5e4) < 0.01;
}

}  // namespace parity
