#include "cpu_reference/sph/pressure.h"

#include <algorithm>

#include "cpu_reference/sph/density.h"
#include "cpu_reference/sph/forces.h"
#include "cpu_reference/sph/kernel.h"
#include "cpu_reference/sph/neighbours.h"
#include "cpu_reference/sph/viscosity.h"

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

/// What half Jacobi steps on the impulses of pressure come to, which stay >= 0.
struct Solve {
  std::vector<dvec3> velocities;
  std::vector<double> impulses;
};

/// @param owed    compression that the velocities need not answer for: density less that at rest.
/// @param solved  whether a particle takes part.
/// @param least   rounds to take at least.
Solve press(const SphParameters& p, const std::vector<Row>& rows,
            const std::vector<dvec3>& predicted, const std::vector<double>& owed,
            const std::vector<bool>& solved, std::vector<double> impulses, double dt,
            std::uint32_t least) {
  Solve solve{predicted, std::move(impulses)};
  for (std::uint32_t round = 1; round <= p.max_iterations; ++round) {
    solve.velocities = pressed(rows, predicted, solve.impulses);
    double sum = 0, largest = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (!solved[i]) continue;
      double rate = 0, diagonal = 0;
      for (const Entry& entry : rows[i]) {
        rate += glm::dot(entry.weight, solve.velocities[entry.particle]);
        diagonal += glm::dot(entry.weight, entry.weight);
      }
      const double excess = owed[i] + dt * rate;
      if (diagonal > 0)
        solve.impulses[i] = std::max(0.0, solve.impulses[i] + excess / (2 * dt * diagonal));
      sum += std::max(0.0, excess / p.rest_density);
      largest = std::max(largest, excess / p.rest_density);
    }
    if (round >= least && sum <= p.density_error * double(rows.size()) &&
        largest <= 10 * p.density_error)
      break;
  }
  return solve;
}

/// Velocities under which nothing inside the fluid is being compressed.
std::vector<dvec3> without_divergence(const SphParameters& p, const std::vector<Row>& rows,
                                      const std::vector<double>& densities,
                                      const std::vector<dvec3>& velocities, double dt) {
  std::vector<bool> inside(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    inside[i] = densities[i] >= sph_inside_density * p.rest_density;
  const std::vector<double> none(rows.size());
  return press(p, rows, velocities, none, inside, none, dt, 1).velocities;
}

}  // namespace

SphPressed sph_pressed_velocities(const SphProblem& problem, const SphNeighbourLists& lists,
                                  const std::vector<double>& densities,
                                  const std::vector<dvec3>& velocities, double dt) {
  const SphParameters& p = problem.parameters;
  const std::vector<Row> rows = rate_matrix(problem, lists);
  const std::vector<dvec3> accelerations = sph_other_accelerations(problem, lists, densities);
  std::vector<dvec3> kicked = velocities;
  for (std::size_t i = 0; i < rows.size(); ++i) kicked[i] += dt * accelerations[i];
  if (p.implicit_viscosity && p.viscosity > 0)
    kicked = sph_viscous_velocities(problem, lists, densities, kicked, dt);
  if (p.method == SphMethod::divergence_free) {
    const std::vector<dvec3> freed = without_divergence(p, rows, densities, velocities, dt);
    for (std::size_t i = 0; i < rows.size(); ++i) kicked[i] += freed[i] - velocities[i];
  }
  std::vector<double> owed(rows.size()), impulses(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    owed[i] = densities[i] - p.rest_density;
    if (!problem.initial.pressures.empty())
      impulses[i] = dt * double(problem.initial.pressures[i]) / (densities[i] * densities[i]);
  }
  const Solve solve = press(p, rows, kicked, owed, std::vector<bool>(rows.size(), true),
                            std::move(impulses), dt, 2);
  SphPressed result{solve.velocities, solve.impulses};
  for (std::size_t i = 0; i < rows.size(); ++i)
    result.pressures[i] *= densities[i] * densities[i] / dt;
  return result;
}

SphPressed sph_incompressible_velocities(const SphProblem& problem) {
  const SphNeighbourLists lists = sph_neighbours(problem);
  const std::vector<dvec3> velocities(problem.initial.velocities.begin(),
                                      problem.initial.velocities.end());
  return sph_pressed_velocities(problem, lists, sph_densities(problem, lists), velocities,
                                problem.parameters.fixed_step);
}

}  // namespace parity::cpu
