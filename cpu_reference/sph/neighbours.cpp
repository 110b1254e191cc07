#include "cpu_reference/sph/neighbours.h"

#include <algorithm>
#include <numeric>

namespace parity::cpu {
namespace {

/// Points in ascending x, and their numbers.
struct Swept {
  std::vector<std::uint32_t> numbers;
  std::vector<float> x;
};

Swept sweep(const std::vector<vec3>& points) {
  Swept swept{std::vector<std::uint32_t>(points.size()), {}};
  std::iota(swept.numbers.begin(), swept.numbers.end(), 0u);
  std::ranges::sort(swept.numbers, {}, [&](std::uint32_t i) { return points[i].x; });
  for (const std::uint32_t i : swept.numbers) swept.x.push_back(points[i].x);
  return swept;
}

bool closer(const vec3& a, const vec3& b, float support) {
  const vec3 d = a - b;
  return d.x * d.x + d.y * d.y + d.z * d.z < support * support;
}

/// Numbers of the points closer than the support, ascending.
std::vector<std::uint32_t> near(const vec3& p, const std::vector<vec3>& points, const Swept& swept,
                                float support) {
  // A little more than the support, as the difference in x may round down.
  const float reach = 1.0001f * support;
  const auto first = std::ranges::lower_bound(swept.x, p.x - reach);
  const auto last = std::ranges::upper_bound(swept.x, p.x + reach);
  std::vector<std::uint32_t> found;
  for (auto at = first; at < last; ++at) {
    const std::uint32_t j = swept.numbers[std::size_t(at - swept.x.begin())];
    if (closer(p, points[j], support)) found.push_back(j);
  }
  std::ranges::sort(found);
  return found;
}

}  // namespace

SphNeighbourLists sph_neighbours(const SphProblem& problem) {
  check_sph_problem(problem);
  return sph_neighbours(problem.initial.positions, problem.boundary,
                        float(problem.parameters.support));
}

SphNeighbourLists sph_neighbours(const std::vector<vec3>& points, const std::vector<vec3>& walls,
                                 float support) {
  const Swept fluid = sweep(points);
  const Swept swept_walls = sweep(walls);
  SphNeighbourLists lists;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    lists.fluid.push_back(near(points[i], points, fluid, support));
    std::erase(lists.fluid.back(), i);
    lists.walls.push_back(near(points[i], walls, swept_walls, support));
  }
  return lists;
}

}  // namespace parity::cpu
