#include "cpu_reference/transform/compose.h"

#include <cmath>

#include "cpu_reference/transform/quaternion.h"

namespace parity::cpu {

dmat4 translation(dvec3 offset) {
  dmat4 matrix{1.0};
  matrix[3] = dvec4(offset, 1.0);
  return matrix;
}

dmat4 rotation(dquat unit) { return dmat4(quaternion_matrix(quaternion_normalize(unit))); }

dmat4 scaling(dvec3 factors) {
  dmat4 matrix{1.0};
  for (int axis = 0; axis < 3; ++axis) matrix[axis][axis] = factors[axis];
  return matrix;
}

std::vector<dmat4> compose(std::span<const Trs> transforms) {
  std::vector<dmat4> matrices;
  matrices.reserve(transforms.size());
  for (const Trs& trs : transforms)
    matrices.push_back(translation(dvec3(trs.translation)) * rotation(dquat(trs.rotation)) *
                       scaling(dvec3(trs.scale)));
  return matrices;
}

dmat3 rotation_2d(double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {dvec3(c, s, 0.0), dvec3(-s, c, 0.0), dvec3(0.0, 0.0, 1.0)};
}

dmat3 scaling_2d(dvec2 factors) {
  return {dvec3(factors.x, 0.0, 0.0), dvec3(0.0, factors.y, 0.0), dvec3(0.0, 0.0, 1.0)};
}

dmat3 shear_2d(dvec2 amounts) {
  return {dvec3(1.0, amounts.y, 0.0), dvec3(amounts.x, 1.0, 0.0), dvec3(0.0, 0.0, 1.0)};
}

dmat3 translation_2d(dvec2 offset) {
  return {dvec3(1.0, 0.0, 0.0), dvec3(0.0, 1.0, 0.0), dvec3(offset, 1.0)};
}

dmat3 about_point(const dmat3& transform, dvec2 center) {
  return translation_2d(center) * transform * translation_2d(-center);
}

}  // namespace parity::cpu
