#include "cpu_reference/sph/pressure.h"

#include <algorithm>

#include "cpu_reference/sph/density.h"
#include "cpu_reference/sph/forces.h"
#include "cpu_reference/sph/kernel.h"
#include "cpu_reference/sph/neighbours.h"

namespace parity::cpu {
namespace {

/// The rate of density of a particle is the sum of weight . velocity over the entries of its row.
struct Entry {
  std::uint32_t particle;
  dvec3 weight;
};
using Row = std::vector<Entry>;

dvec3 gradient_between(const SphParameters& p, const vec3& a, const vec3& b) {
  const dvec3 d = dvec3(a) - dvec3(b);
  const double r = glm::length(d);
  if (r == 0) return dvec3(0);
  return sph_kernel_derivative(p.kernel, p.dimensions, r, p.support) * d / r;
}

/// The particle's own entry stands first.
std::vector<Row> rate_matrix(const SphProblem& problem, const SphNeighbourLists& lists) {
  const SphParameters& p = problem.parameters;
  const std::vector<vec3>& points = problem.initial.positions;
  const std::vector<double> volumes = sph_wall_volumes(problem);
  std::vector<Row> rows(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    rows[i].push_back({i, dvec3(0)});
    for (const std::uint32_t j : lists.fluid[i]) {
      const dvec3 weight = particle_mass(p) * gradient_between(p, points[i], points[j]);
      rows[i][0].weight += weight;
      rows[i].push_back({j, -weight});
    }
    for (const std::uint32_t j : lists.walls[i])
      rows[i][0].weight +=
          p.rest_density * volumes[j] * gradient_between(p, points[i], problem.boundary[j]);
  }
  return rows;
}

/// Velocities less the transposed matrix times the impulses.
std::vector<dvec3> pressed(const std::vector<Row>& rows, std::vector<dvec3> velocities,
                           const std::vector<double>& impulses) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const Entry& entry : rows[i]) velocities[entry.particle] -= impulses[i] * entry.weight;
  return velocities;
}

}  // namespace

SphPressed sph_incompressible_velocities(const SphProblem& problem, int rounds) {
  const SphParameters& p = problem.parameters;
  const double dt = p.fixed_step;
  const SphNeighbourLists lists = sph_neighbours(problem);
  const std::vector<double> densities = sph_densities(problem, lists);
  const std::vector<Row> rows = rate_matrix(problem, lists);
  std::vector<dvec3> predicted = sph_other_accelerations(problem, lists, densities);
  for (std::size_t i = 0; i < rows.size(); ++i)
    predicted[i] = dvec3(problem.initial.velocities[i]) + dt * predicted[i];
  SphPressed result{predicted, std::vector<double>(rows.size())};
  std::vector<double> impulses(rows.size());
  for (int round = 0; round < rounds; ++round) {
    result.velocities = pressed(rows, predicted, impulses);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      double rate = 0, diagonal = 0;
      for (const Entry& entry : rows[i]) {
        rate += glm::dot(entry.weight, result.velocities[entry.particle]);
        diagonal += glm::dot(entry.weight, entry.weight);
      }
      const double excess = densities[i] - p.rest_density + dt * rate;
      if (diagonal > 0) impulses[i] = std::max(0.0, impulses[i] + excess / (2 * dt * diagonal));
    }
  }
  for (std::size_t i = 0; i < rows.size(); ++i)
    result.pressures[i] = impulses[i] * densities[i] * densities[i] / dt;
  return result;
}

}  // namespace parity::cpu
