#include "cpu_reference/shading/shadow_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace parity::cpu {
namespace {

/// Length of the part of [a, a + 1] within [low, high].
double overlap(double a, double low, double high) {
  return std::max(0.0, std::min(a + 1, high) - std::max(a, low));
}

}  // namespace

double shadow_filter(const Grid<float>& map, const vec2& place, float depth, int radius) {
  const int side = map.width();
  // The middle of the box in texels, rounded as the device does.
  const float size = float(side);
  const dvec2 middle{double(place.x * size - 0.5f) + 0.5, double(place.y * size - 0.5f) + 0.5};
  const double reach = radius + 0.5;
  const dvec2 low = middle - reach, high = middle + reach;
  double lit = 0;
  for (int y = int(std::floor(low.y)); y <= int(std::floor(high.y)); ++y)
    for (int x = int(std::floor(low.x)); x <= int(std::floor(high.x)); ++x) {
      const bool inside = x >= 0 && y >= 0 && x < side && y < side;
      if (inside && depth > map(x, y)) continue;
      lit += overlap(x, low.x, high.x) * overlap(y, low.y, high.y);
    }
  return lit / ((2 * reach) * (2 * reach));
}

std::vector<double> shadow_map(const ShadowProblem& p) {
  std::vector<double> result;
  result.reserve(p.points.size());
  for (const vec4& point : p.points) {
    int cascade = 0;
    while (cascade < 4 && !(point.w <= p.ends[cascade])) ++cascade;
    if (cascade == 4) {
      result.push_back(1);
      continue;
    }
    const mat4& m = p.shadow_from_world[std::size_t(cascade)];
    const vec4 place = ((m[0] * point.x + m[1] * point.y) + m[2] * point.z) + m[3];
    const float depth = place.z - p.bias;
    result.push_back(shadow_filter(p.depths[std::size_t(cascade)], vec2(place), depth, p.radius));
  }
  return result;
}

namespace {

constexpr double half_ulp = 0x1p-24;

/// A number and how far a device's may be off.
struct Doubtful {
  double value = 0;
  double error = 0;
};

/// A row of a matrix of floats times a point: each product rounds twice and is added with others.
Doubtful row_times(const dmat4& m, int row, const dvec3& p, const dvec3& error) {
  Doubtful sum{m[3][row], std::abs(m[3][row]) * 8 * half_ulp};
  for (int i = 0; i < 3; ++i) {
    sum.value += m[i][row] * p[i];
    sum.error += std::abs(m[i][row]) * (error[i] + 8 * half_ulp * std::abs(p[i]));
  }
  return sum;
}

Doubtful quotient(const Doubtful& a, const Doubtful& b) {
  const double value = a.value / b.value;
  if (!(b.value > b.error)) return {value, std::numeric_limits<double>::infinity()};
  return {value, (a.error + std::abs(value) * b.error) / (b.value - b.error) +
                     4 * half_ulp * std::abs(value)};
}

Visibility in_map(const LightShadow& shadow, std::size_t k, const ShadowQuery& query) {
  const ShadowCascade& cascade = shadow.cascades[k];
  dmat4 from_origin(1.0);
  from_origin[3] = dvec4(query.origin, 1);
  const dmat4 m = cascade.shadow_from_world * from_origin;
  const dvec3 p = query.position - query.origin;
  const Doubtful at = row_times(m, 3, p, query.position_error);
  const double lift = shadow.lift(k) * at.value;
  const dvec3 lifted = p + query.normal * lift;
  const dvec3 error =
      query.position_error +
      dvec3(shadow.lift(k) * at.error + std::abs(lift) * (query.normal_error + 8 * half_ulp)) +
      glm::abs(lifted) * half_ulp;
  const Doubtful w = row_times(m, 3, lifted, error);
  if (!(w.value + w.error > 0)) return {};
  const Doubtful x = quotient(row_times(m, 0, lifted, error), w);
  const Doubtful y = quotient(row_times(m, 1, lifted, error), w);
  const Doubtful z = quotient(row_times(m, 2, lifted, error), w);
  const double depth = std::min(z.value - double(shadow.bias), 1.0);
  const double off = z.error + 2 * half_ulp;
  const vec2 place(float(x.value), float(y.value));
  const auto filtered = [&](double d) {
    return shadow_filter(cascade.depths, place, float(std::min(d, 1.0)), shadow.radius);
  };
  // Over a texel on either axis the box loses and gains at most a column of it.
  const double moved =
      (x.error + y.error + half_ulp * (std::abs(x.value) + std::abs(y.value) + 4)) *
      cascade.depths.width() / (2 * shadow.radius + 1);
  Visibility result{filtered(depth), 0, 1};
  if (!std::isfinite(moved) || !std::isfinite(off)) return result;
  result.low = std::clamp(filtered(depth + off) - moved, 0.0, result.value);
  result.high = std::clamp(filtered(depth - off) + moved, result.value, 1.0);
  if (w.value <= w.error) result.high = 1;
  return result;
}

/// The face of a cube that shows what lies that way.
std::size_t face_toward(const dvec3& way) {
  std::size_t face = 0;
  double most = -1;
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(way[axis]) > most) {
      most = std::abs(way[axis]);
      face = std::size_t(2 * axis + (way[axis] < 0 ? 1 : 0));
    }
  return face;
}

/// Where the largest component is in doubt any of the faces may be asked.
Visibility in_cube(const LightShadow& shadow, const ShadowQuery& query) {
  const dvec3 way = query.position - shadow.center;
  const dvec3 error = query.position_error + 4 * half_ulp *
                                                 (glm::abs(query.position - query.origin) +
                                                  glm::abs(shadow.center - query.origin));
  double most = 0;
  for (int axis = 0; axis < 3; ++axis) most = std::max(most, std::abs(way[axis]) - error[axis]);
  const std::size_t right = face_toward(way);
  Visibility result = in_map(shadow, right, query);
  for (std::size_t face = 0; face < 6; ++face) {
    const int axis = int(face / 2);
    if (face == right || (face % 2 ? -way[axis] : way[axis]) + error[axis] < most) continue;
    const Visibility other = in_map(shadow, face, query);
    result.low = std::min(result.low, other.low);
    result.high = std::max(result.high, other.high);
  }
  return result;
}

}  // namespace

Visibility visibility(const LightShadow& shadow, const ShadowQuery& query) {
  if (shadow.is_cube) return in_cube(shadow, query);
  const double distance = glm::dot(shadow.forward, query.position) + shadow.offset;
  const double from_origin = std::abs(glm::dot(shadow.forward, query.origin) + shadow.offset);
  const double error =
      glm::dot(glm::abs(shadow.forward),
               query.position_error + 8 * half_ulp * glm::abs(query.position - query.origin)) +
      8 * half_ulp * from_origin + half_ulp * std::abs(distance);
  Visibility result;
  bool is_found = false;
  double begin = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < shadow.cascades.size(); ++k) {
    const double end = shadow.cascades[k].end;
    const double doubt = 2 * error;  // ends are rounded as distances are
    if (distance <= end + doubt && distance >= begin - doubt) {
      const Visibility one = in_map(shadow, k, query);
      const bool is_right = distance <= end && distance > begin;
      const bool is_first = !is_found;
      is_found = true;
      result.low = is_first ? one.low : std::min(result.low, one.low);
      result.high = is_first ? one.high : std::max(result.high, one.high);
      if (is_right || is_first) result.value = one.value;
    }
    begin = end;
  }
  // Beyond the last one nothing hides.
  if (is_found && distance + error > begin) result.high = 1;
  return result;
}

}  // namespace parity::cpu
