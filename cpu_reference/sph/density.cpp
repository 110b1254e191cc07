#include "cpu_reference/sph/density.h"

#include <algorithm>
#include <cmath>

#include "cpu_reference/sph/kernel.h"
#include "cpu_reference/sph/neighbours.h"

namespace parity::cpu {
namespace {

double kernel_between(const SphParameters& p, const vec3& a, const vec3& b) {
  return sph_kernel(p.kernel, p.dimensions, glm::length(dvec3(a) - dvec3(b)), p.support);
}

}  // namespace

std::vector<double> sph_wall_volumes(const SphProblem& problem) {
  const std::vector<vec3>& walls = problem.boundary;
  const SphNeighbourLists lists = sph_neighbours(walls, {}, float(problem.parameters.support));
  std::vector<double> volumes;
  for (std::size_t i = 0; i < problem.boundary.size(); ++i) {
    const vec3 at = problem.boundary[i];
    double sum = kernel_between(problem.parameters, at, at);
    for (const std::uint32_t j : lists.fluid[i])
      sum += kernel_between(problem.parameters, at, problem.boundary[j]);
    volumes.push_back(1 / sum);
  }
  return volumes;
}

std::vector<double> sph_densities(const SphProblem& problem, const SphNeighbourLists& neighbours) {
  const SphParameters& p = problem.parameters;
  const std::vector<vec3>& points = problem.initial.positions;
  const std::vector<double> volumes = sph_wall_volumes(problem);
  std::vector<double> densities;
  for (std::size_t i = 0; i < points.size(); ++i) {
    double density = particle_mass(p) * kernel_between(p, points[i], points[i]);
    for (const std::uint32_t j : neighbours.fluid[i])
      density += particle_mass(p) * kernel_between(p, points[i], points[j]);
    for (const std::uint32_t j : neighbours.walls[i])
      density += p.rest_density * volumes[j] * kernel_between(p, points[i], problem.boundary[j]);
    densities.push_back(density);
  }
  return densities;
}

double sph_pressure(const SphParameters& p, double density) {
  const double c2 = p.sound_speed * p.sound_speed;
  const double pressure =
      p.equation_of_state == SphEquationOfState::linear
          ? c2 * (density - p.rest_density)
          : p.rest_density * c2 / 7 * (std::pow(density / p.rest_density, 7) - 1);
  return std::max(0.0, pressure);
}

}  // namespace parity::cpu
