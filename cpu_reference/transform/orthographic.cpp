#include "cpu_reference/transform/orthographic.h"

#include <cmath>
#include <stdexcept>

namespace parity::cpu {
namespace {

void check_side(float from, float to) {
  const float length = to - from;
  if (!std::isfinite(length) || length == 0.0f)
    throw std::invalid_argument("cpu::orthographic: a side has length " + std::to_string(length) +
                                ", must be finite and not 0");
}

}  // namespace

std::vector<dmat4> orthographic(std::span<const ViewVolume> volumes, DepthMode depth) {
  std::vector<dmat4> matrices;
  matrices.reserve(volumes.size());
  for (const ViewVolume& v : volumes) {
    check_side(v.left, v.right);
    check_side(v.bottom, v.top);
    check_side(v.near, v.far);
    const double l = v.left, r = v.right, b = v.bottom, t = v.top, n = v.near, f = v.far;
    dmat4 matrix{1.0};
    matrix[0][0] = 2.0 / (r - l);
    matrix[3][0] = -(r + l) / (r - l);
    matrix[1][1] = -2.0 / (t - b);
    matrix[3][1] = (t + b) / (t - b);
    const bool reverse = depth == DepthMode::reverse_z;
    matrix[2][2] = (reverse ? 1.0 : -1.0) / (f - n);
    matrix[3][2] = (reverse ? f : -n) / (f - n);
    matrices.push_back(matrix);
  }
  return matrices;
}

}  // namespace parity::cpu
