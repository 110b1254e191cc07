#include "cpu_reference/transform/rotate.h"

#include <cmath>
#include <stdexcept>

namespace parity::cpu {
namespace {

dmat3 rodrigues_matrix(dvec3 axis, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const dmat3 cross{dvec3(0.0, axis.z, -axis.y), dvec3(-axis.z, 0.0, axis.x),
                    dvec3(axis.y, -axis.x, 0.0)};
  return dmat3(1.0) * c + cross * s + glm::outerProduct(axis, axis) * (1.0 - c);
}

}  // namespace

dmat3 rotation_x(double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {dvec3(1.0, 0.0, 0.0), dvec3(0.0, c, s), dvec3(0.0, -s, c)};
}

dmat3 rotation_y(double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {dvec3(c, 0.0, -s), dvec3(0.0, 1.0, 0.0), dvec3(s, 0.0, c)};
}

dmat3 rotation_z(double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {dvec3(c, s, 0.0), dvec3(-s, c, 0.0), dvec3(0.0, 0.0, 1.0)};
}

std::vector<dmat3> rotate(std::span<const AxisAngle> rotations) {
  std::vector<dmat3> matrices;
  matrices.reserve(rotations.size());
  for (const AxisAngle& rotation : rotations) {
    const dvec3 axis{rotation.axis};
    const double length = glm::length(axis);
    if (!(length > 0.0) || !std::isfinite(length))
      throw std::invalid_argument("cpu::rotate: axis has length " + std::to_string(length) +
                                  ", must be finite and > 0");
    matrices.push_back(rodrigues_matrix(axis / length, double(rotation.angle)));
  }
  return matrices;
}

dvec3 rodrigues(dvec3 vector, dvec3 axis, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return vector * c + glm::cross(axis, vector) * s + axis * glm::dot(axis, vector) * (1.0 - c);
}

}  // namespace parity::cpu
