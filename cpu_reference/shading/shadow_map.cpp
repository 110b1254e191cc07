#include "cpu_reference/shading/shadow_map.h"

#include <algorithm>
#include <cmath>

namespace parity::cpu {
namespace {

/// Length of the part of [a, a + 1] within [low, high].
double overlap(double a, double low, double high) {
  return std::max(0.0, std::min(a + 1, high) - std::max(a, low));
}

double visibility(const Grid<float>& map, const vec2& place, float depth, int radius) {
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

}  // namespace

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
    result.push_back(visibility(p.depths[std::size_t(cascade)], vec2(place), depth, p.radius));
  }
  return result;
}

}  // namespace parity::cpu
