#include "cpu_reference/transform/perspective.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace parity::cpu {
namespace {

void check(const ViewVolume& v) {
  if (!(v.left < v.right || v.left > v.right) || !(v.bottom < v.top || v.bottom > v.top))
    throw std::invalid_argument("cpu::perspective: the volume has a side of length 0 or NaN");
  if (!(v.near > 0.0f) || !(v.far > v.near))
    throw std::invalid_argument("cpu::perspective: near is " + std::to_string(v.near) +
                                ", far is " + std::to_string(v.far) + ", must be 0 < near < far");
}

/// Row z of the matrix: clip z = a z + b for view depths -near and -far.
struct DepthRow {
  double a;
  double b;
};

DepthRow depth_row(double near, double far, DepthMode depth) {
  if (depth == DepthMode::reverse_z)
    return std::isinf(far) ? DepthRow{0.0, near}
                           : DepthRow{near / (far - near), far * near / (far - near)};
  return std::isinf(far) ? DepthRow{-1.0, -near}
                         : DepthRow{-far / (far - near), -far * near / (far - near)};
}

dmat4 frustum(const ViewVolume& v, double y_sign, DepthRow row) {
  const double l = v.left, r = v.right, b = v.bottom, t = v.top, n = v.near;
  dmat4 matrix{0.0};
  matrix[0][0] = 2.0 * n / (r - l);
  matrix[2][0] = (r + l) / (r - l);
  matrix[1][1] = y_sign * 2.0 * n / (t - b);
  matrix[2][1] = y_sign * (t + b) / (t - b);
  matrix[2][2] = row.a;
  matrix[3][2] = row.b;
  matrix[2][3] = -1.0;
  return matrix;
}

}  // namespace

std::vector<dmat4> perspective(std::span<const ViewVolume> volumes, DepthMode depth) {
  std::vector<dmat4> matrices;
  matrices.reserve(volumes.size());
  for (const ViewVolume& volume : volumes) {
    check(volume);
    matrices.push_back(frustum(volume, -1.0, depth_row(volume.near, volume.far, depth)));
  }
  return matrices;
}

dmat4 perspective_gl(const ViewVolume& volume) {
  check(volume);
  if (std::isinf(volume.far))
    throw std::invalid_argument("cpu::perspective_gl: far is infinite, must be finite");
  const double n = volume.near, f = volume.far;
  return frustum(volume, 1.0, {-(f + n) / (f - n), -2.0 * f * n / (f - n)});
}

dmat4 squeeze(double near, double far) {
  if (!(near > 0.0) || !(far > near) || std::isinf(far))
    throw std::invalid_argument("cpu::squeeze: near is " + std::to_string(near) + ", far is " +
                                std::to_string(far) + ", must be 0 < near < far < infinity");
  dmat4 matrix{0.0};
  matrix[0][0] = near;
  matrix[1][1] = near;
  matrix[2][2] = near + far;
  matrix[3][2] = far * near;
  matrix[2][3] = -1.0;
  return matrix;
}

double focal_length(double height, double vertical_fov) {
  return 0.5 * height / std::tan(0.5 * vertical_fov);
}

}  // namespace parity::cpu
