#include "cpu_reference/transform/quaternion.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace parity::cpu {
namespace {

double squared_norm(dquat q) { return q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z; }

/// |q|^2, checked to be a divisor.
double checked_squared_norm(dquat q, const char* who) {
  const double norm = squared_norm(q);
  if (!(norm > 0.0) || !std::isfinite(norm))
    throw std::invalid_argument(std::string("cpu::") + who + ": |q|^2 is " + std::to_string(norm) +
                                ", must be finite and > 0");
  return norm;
}

dquat product(dquat p, dquat q) {
  const dvec3 a{p.x, p.y, p.z};
  const dvec3 b{q.x, q.y, q.z};
  const dvec3 v = p.w * b + q.w * a + glm::cross(a, b);
  return dquat(p.w * q.w - glm::dot(a, b), v.x, v.y, v.z);
}

}  // namespace

dquat quaternion_from_axis_angle(dvec3 axis, double angle) {
  const double length = glm::length(axis);
  if (!(length > 0.0) || !std::isfinite(length))
    throw std::invalid_argument("cpu::quaternion_from_axis_angle: axis has length " +
                                std::to_string(length) + ", must be finite and > 0");
  const dvec3 v = std::sin(0.5 * angle) * (axis / length);
  return dquat(std::cos(0.5 * angle), v.x, v.y, v.z);
}

dquat quaternion_normalize(dquat q) {
  const double norm = std::sqrt(checked_squared_norm(q, "quaternion_normalize"));
  return dquat(q.w / norm, q.x / norm, q.y / norm, q.z / norm);
}

dquat quaternion_compose(dquat second, dquat first) { return product(second, first); }

dquat quaternion_inverse(dquat q) {
  const double norm = checked_squared_norm(q, "quaternion_inverse");
  return dquat(q.w / norm, -q.x / norm, -q.y / norm, -q.z / norm);
}

dvec3 quaternion_rotate(dquat q, dvec3 v) {
  const dquat turned = product(product(q, dquat(0.0, v.x, v.y, v.z)), quaternion_inverse(q));
  return {turned.x, turned.y, turned.z};
}

dmat3 quaternion_matrix(dquat unit) {
  const dmat3 cross{dvec3(0.0, unit.z, -unit.y), dvec3(-unit.z, 0.0, unit.x),
                    dvec3(unit.y, -unit.x, 0.0)};
  return dmat3(1.0) + 2.0 * unit.w * cross + 2.0 * cross * cross;
}

std::vector<dmat3> quaternion_matrix(std::span<const quat> units) {
  std::vector<dmat3> matrices;
  matrices.reserve(units.size());
  for (const quat& unit : units) matrices.push_back(quaternion_matrix(dquat(unit)));
  return matrices;
}

std::vector<dvec3> quaternion_rotate(std::span<const quat> quaternions,
                                     std::span<const vec3> vectors) {
  if (quaternions.size() != vectors.size())
    throw std::invalid_argument("cpu::quaternion_rotate: " + std::to_string(quaternions.size()) +
                                " quaternions and " + std::to_string(vectors.size()) +
                                " vectors, must be as many");
  std::vector<dvec3> turned;
  turned.reserve(vectors.size());
  for (std::size_t i = 0; i < vectors.size(); ++i)
    turned.push_back(quaternion_rotate(dquat(quaternions[i]), dvec3(vectors[i])));
  return turned;
}

}  // namespace parity::cpu
