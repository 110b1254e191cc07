#include "cpu_reference/shading/area_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cpu_reference/shading/brdf.h"

namespace parity::cpu {
namespace {

using std::numbers::pi;

/// Sutherland and Hodgman's, against the plane through the origin with this normal.
std::vector<dvec3> above_horizon(const std::vector<dvec3>& polygon, const dvec3& normal) {
  std::vector<dvec3> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const dvec3& a = polygon[i];
    const dvec3& b = polygon[(i + 1) % polygon.size()];
    const double height_a = glm::dot(normal, a), height_b = glm::dot(normal, b);
    if (height_a >= 0) kept.push_back(a);
    if ((height_a >= 0) != (height_b >= 0))
      kept.push_back(a + (b - a) * (height_a / (height_a - height_b)));
  }
  return kept;
}

double irradiance(const RectangleQuery& q) {
  std::vector<dvec3> polygon;
  for (const vec3& corner : q.corners) polygon.push_back(dvec3(corner) - dvec3(q.point));
  const dvec3 normal{q.normal};
  polygon = above_horizon(polygon, normal);
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const dvec3 a = glm::normalize(polygon[i]);
    const dvec3 b = glm::normalize(polygon[(i + 1) % polygon.size()]);
    const dvec3 across = glm::cross(a, b);
    const double sine = glm::length(across);
    if (sine > 0) sum += std::atan2(sine, glm::dot(a, b)) * glm::dot(normal, across) / sine;
  }
  return std::abs(sum) / 2;
}

double highlight(const SphereQuery& q) {
  const dvec3 center{q.center}, v{q.to_eye};
  const dvec3 mirror = 2 * v.z * dvec3(0, 0, 1) - v;
  const double distance = glm::length(center);
  const dvec3 foot = glm::dot(center, mirror) * mirror;
  const double off = glm::length(foot - center);
  const dvec3 nearest = off > q.radius ? center + (foot - center) * (double(q.radius) / off) : foot;
  const dvec3 l = glm::normalize(nearest);
  if (!(l.z > 0)) return 0;
  const dvec3 h = glm::normalize(l + v);
  const double alpha = q.alpha;
  const double wider = std::min(1.0, alpha + q.radius / (2 * distance));
  const double f = ggx_density(h, dvec2(alpha)) * ggx_shadowing(l, v, dvec2(alpha)) / (4 * v.z);
  return f * std::pow(alpha / wider, 2) * pi * std::pow(q.radius / distance, 2);
}

}  // namespace

std::vector<double> rectangle_light(std::span<const RectangleQuery> queries) {
  std::vector<double> values;
  values.reserve(queries.size());
  for (const RectangleQuery& q : queries) values.push_back(irradiance(q));
  return values;
}

double rectangle_by_quadrature(const RectangleQuery& q, int n) {
  const dvec3 origin = dvec3(q.corners[0]) - dvec3(q.point);
  const dvec3 s = dvec3(q.corners[1]) - dvec3(q.corners[0]);
  const dvec3 t = dvec3(q.corners[3]) - dvec3(q.corners[0]);
  const dvec3 area = glm::cross(s, t) / (double(n) * n);
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const dvec3 p = origin + s * ((i + 0.5) / n) + t * ((j + 0.5) / n);
      const double squared = glm::dot(p, p);
      sum += std::max(0.0, glm::dot(dvec3(q.normal), p)) * std::abs(glm::dot(area, p)) /
             (squared * squared);
    }
  return sum;
}

std::vector<double> sphere_light(std::span<const SphereQuery> queries) {
  std::vector<double> values;
  values.reserve(queries.size());
  for (const SphereQuery& q : queries) values.push_back(highlight(q));
  return values;
}

double sphere_by_quadrature(const SphereQuery& q, int n) {
  const dvec3 center{q.center}, v{q.to_eye};
  const double distance = glm::length(center);
  const dvec3 axis = center / distance;
  const dvec3 s =
      glm::normalize(glm::cross(std::abs(axis.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0), axis));
  const dvec3 t = glm::cross(axis, s);
  const double edge = 1 - std::sqrt(1 - std::pow(q.radius / distance, 2));  // 1 - cos
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double cosine = 1 - edge * (i + 0.5) / n, phi = 2 * pi * (j + 0.5) / n;
      const double sine = std::sqrt(1 - cosine * cosine);
      const dvec3 l = axis * cosine + (s * std::cos(phi) + t * std::sin(phi)) * sine;
      if (!(l.z > 0)) continue;
      const dvec3 h = glm::normalize(l + v);
      sum += ggx_density(h, dvec2(q.alpha)) * ggx_shadowing(l, v, dvec2(q.alpha)) / (4 * v.z);
    }
  return sum * 2 * pi * edge / (double(n) * n);
}

}  // namespace parity::cpu
