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

/// Density over rest density that a half space of lattice gives to a point above its first layer.
double half_space(const SphParameters& p, int layers) {
  const int n = int(p.support / p.spacing) + 1;
  double sum = 0;
  for (int y = 1; y <= layers; ++y)
    for (int x = -n; x <= n; ++x)
      for (int z = p.dimensions == 3 ? -n : 0; z <= (p.dimensions == 3 ? n : 0); ++z)
        sum +=
            sph_kernel(p.kernel, p.dimensions, p.spacing * glm::length(dvec3(x, y, z)), p.support);
  return sum * std::pow(p.spacing, int(p.dimensions));
}

/// 1 / sum of W over a flat layer, per volume of a lattice cell.
double flat_volume(const SphParameters& p) {
  const int n = int(p.support / p.spacing) + 1;
  double sum = 0;
  for (int x = -n; x <= n; ++x)
    for (int z = p.dimensions == 3 ? -n : 0; z <= (p.dimensions == 3 ? n : 0); ++z)
      sum += sph_kernel(p.kernel, p.dimensions, p.spacing * glm::length(dvec3(x, 0, z)), p.support);
  return 1 / (sum * std::pow(p.spacing, int(p.dimensions)));
}

}  // namespace

std::vector<double> sph_wall_volumes(const SphProblem& problem) {
  const std::vector<vec3>& walls = problem.boundary;
  const SphNeighbourLists lists = sph_neighbours(walls, {}, float(problem.parameters.support));
  const SphParameters& p = problem.parameters;
  const double share =
      half_space(p, int(p.support / p.spacing) + 1) / (flat_volume(p) * half_space(p, 1));
  std::vector<double> volumes;
  for (std::size_t i = 0; i < problem.boundary.size(); ++i) {
    const vec3 at = problem.boundary[i];
    double sum = kernel_between(p, at, at);
    for (const std::uint32_t j : lists.fluid[i]) sum += kernel_between(p, at, problem.boundary[j]);
    volumes.push_back(share / sum);
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
