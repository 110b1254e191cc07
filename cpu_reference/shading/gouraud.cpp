#include "cpu_reference/shading/gouraud.h"

#include <cmath>
#include <numbers>

namespace parity::cpu {
namespace {

using std::numbers::pi;

double radiance(const GouraudQuery& q, const dvec3& position, const dvec3& normal) {
  const dvec3 offset = dvec3(q.light) - position;
  const double distance = glm::length(offset);
  const double cosine = glm::dot(normal, offset) / distance;
  if (!(cosine > 0)) return 0;
  const dvec3 h = glm::normalize(offset / distance + glm::normalize(dvec3(q.eye) - position));
  const double e = q.exponent;
  const double factor = (e + 2) * (e + 4) / (8 * pi * (std::exp2(-e / 2) + e));
  const double lobe = std::pow(std::max(0.0, glm::dot(normal, h)), e);
  const double s = q.specular;
  return ((1 - s) / pi + s * factor * lobe) * cosine / (distance * distance);
}

}  // namespace

std::vector<dvec2> gouraud(std::span<const GouraudQuery> queries) {
  std::vector<dvec2> values;
  values.reserve(queries.size());
  for (const GouraudQuery& q : queries) {
    dvec3 position{0.0}, normal{0.0};
    double corners = 0;
    for (int k = 0; k < 3; ++k) {
      const double weight = q.place[k];
      position += weight * dvec3(q.corners[k]);
      normal += weight * dvec3(q.normals[k]);
      corners += weight * radiance(q, dvec3(q.corners[k]), dvec3(q.normals[k]));
    }
    values.emplace_back(corners, radiance(q, position, glm::normalize(normal)));
  }
  return values;
}

}  // namespace parity::cpu
