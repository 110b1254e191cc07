#include "cpu_reference/sph/forces.h"

#include <algorithm>

#include "cpu_reference/sph/density.h"
#include "cpu_reference/sph/kernel.h"

namespace parity::cpu {
namespace {

/// Two points of a fluid, seen from the first.
struct Pair {
  dvec3 apart;     ///< position against the other's
  dvec3 velocity;  ///< against the other's
  double distance;
  dvec3 gradient;  ///< of W at the first
};

Pair pair_of(const SphParameters& p, const dvec3& apart, const dvec3& velocity) {
  const double r = glm::length(apart);
  const double slope = sph_kernel_derivative(p.kernel, p.dimensions, r, p.support);
  return {apart, velocity, r, r > 0 ? slope / r * apart : dvec3(0)};
}

/// Acceleration by friction with a mass at a mean density; `share` of the laminar viscosity.
dvec3 friction(const SphParameters& p, const Pair& pair, double mass, double density,
               double share) {
  const double h = p.support / 2;
  const double along = glm::dot(pair.velocity, pair.apart);
  const double squares = pair.distance * pair.distance + 0.01 * h * h;
  const double viscosity = p.implicit_viscosity ? 0 : share * p.viscosity;
  dvec3 result =
      2.0 * (p.dimensions + 2) * viscosity * mass / density * along / squares * pair.gradient;
  if (along < 0 && p.method == SphMethod::weakly_compressible) {
    const double mu = h * along / squares;
    result += mass * p.artificial_viscosity * p.sound_speed * mu / density * pair.gradient;
  }
  return result;
}

std::vector<dvec3> sum_accelerations(const SphProblem& problem, const SphNeighbourLists& neighbours,
                                     const std::vector<double>& rho, bool with_pressure) {
  const SphParameters& p = problem.parameters;
  const SphState& state = problem.initial;
  const double mass = particle_mass(p);
  const std::vector<double> volumes = sph_wall_volumes(problem);
  const auto pressed = [&](std::size_t i) {
    return with_pressure ? sph_pressure(p, rho[i]) / (rho[i] * rho[i]) : 0.0;
  };
  std::vector<dvec3> result(rho.size(), p.gravity);
  for (std::size_t i = 0; i < rho.size(); ++i) {
    const dvec3 at{state.positions[i]};
    const dvec3 v{state.velocities[i]};
    for (const std::uint32_t j : neighbours.fluid[i]) {
      const Pair pair = pair_of(p, at - dvec3(state.positions[j]), v - dvec3(state.velocities[j]));
      result[i] -= mass * (pressed(i) + pressed(j)) * pair.gradient;
      result[i] += friction(p, pair, mass, (rho[i] + rho[j]) / 2, 1);
      result[i] -= p.surface_tension * mass / p.rest_density *
                   sph_kernel(p.kernel, p.dimensions, pair.distance, p.support) * pair.apart;
    }
    for (const std::uint32_t j : neighbours.walls[i]) {
      const dvec4 motion =
          problem.boundary_motions.empty() ? dvec4(0, 0, 0, 1) : dvec4(problem.boundary_motions[j]);
      const Pair pair = pair_of(p, at - dvec3(problem.boundary[j]), v - dvec3(motion));
      const double wall = p.rest_density * volumes[j];
      // The wall answers with the particle's own pressure, carried to the wall's depth, within
      // twice that: under no pressure nothing is held.
      const double depth = glm::dot(p.gravity, pair.apart);
      const double answer =
          with_pressure ? std::clamp(pressed(i) - depth / rho[i], 0.0, 2 * pressed(i)) : 0.0;
      result[i] -= wall * (pressed(i) + answer) * pair.gradient;
      result[i] += friction(p, pair, wall, rho[i], motion.w);
    }
  }
  return result;
}

}  // namespace

std::vector<dvec3> sph_accelerations(const SphProblem& problem, const SphNeighbourLists& neighbours,
                                     const std::vector<double>& densities) {
  return sum_accelerations(problem, neighbours, densities, true);
}

std::vector<dvec3> sph_other_accelerations(const SphProblem& problem,
                                           const SphNeighbourLists& neighbours,
                                           const std::vector<double>& densities) {
  return sum_accelerations(problem, neighbours, densities, false);
}

}  // namespace parity::cpu
