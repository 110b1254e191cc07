#include "cpu_reference/sph/step.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cpu_reference/sph/density.h"
#include "cpu_reference/sph/forces.h"
#include "cpu_reference/sph/kernel.h"
#include "cpu_reference/sph/neighbours.h"
#include "cpu_reference/sph/pressure.h"
#include "cpu_reference/sph/viscosity.h"

namespace parity::cpu {
namespace {

/// Of a wave on the lattice: omega / c, and the rate of friction.
struct Rates {
  double wave = 0;
  double friction = 0;
};

Rates rates_of(const SphParameters& p, const dvec3& k) {
  const int reach = int(std::ceil(p.support / p.spacing));
  const int reach_z = p.dimensions == 3 ? reach : 0;
  const double volume = std::pow(p.spacing, int(p.dimensions));
  const double h = p.support / 2;
  const double nu = 2.0 * (p.dimensions + 2) * p.viscosity;
  dvec3 wave(0);
  dmat3 friction(0);
  for (int z = -reach_z; z <= reach_z; ++z)
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x) {
        const dvec3 d = p.spacing * dvec3(x, y, z);
        const double r = glm::length(d);
        if (r == 0 || r >= p.support) continue;
        const double slope = sph_kernel_derivative(p.kernel, p.dimensions, r, p.support);
        wave += volume * slope / r * std::sin(glm::dot(k, d)) * d;
        friction -= volume * nu * slope / r / (r * r + 0.01 * h * h) *
                    (1 - std::cos(glm::dot(k, d))) * glm::outerProduct(d, d);
      }
  // The largest eigenvalue of a symmetric positive matrix, by powers.
  dvec3 v(0.7, 0.5, p.dimensions == 3 ? 0.3 : 0.0);
  double largest = 0;
  for (int round = 0; round < 60; ++round) {
    const dvec3 next = friction * v;
    largest = glm::length(next);
    if (largest == 0) break;
    v = next / largest;
  }
  return {glm::length(wave), largest};
}

/// Velocities at the end of a step; the state's pressures become those of the step where they are
/// solved for.
std::vector<dvec3> kicked(SphProblem& now, const SphNeighbourLists& lists,
                          const std::vector<dvec3>& velocities, double step) {
  const std::vector<double> densities = sph_densities(now, lists);
  if (now.parameters.method != SphMethod::weakly_compressible) {
    SphPressed pressed = sph_pressed_velocities(now, lists, densities, velocities, step);
    now.initial.pressures.assign(pressed.pressures.begin(), pressed.pressures.end());
    return std::move(pressed.velocities);
  }
  std::vector<dvec3> result = sph_accelerations(now, lists, densities);
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = velocities[i] + step * result[i];
  if (now.parameters.implicit_viscosity && now.parameters.viscosity > 0)
    result = sph_viscous_velocities(now, lists, densities, result, step);
  return result;
}

}  // namespace

SphState sph_step(const SphProblem& problem, double step, int count) {
  check_sph_parameters(problem.parameters);
  SphProblem now = problem;
  std::vector<dvec3> positions(problem.initial.positions.begin(), problem.initial.positions.end());
  std::vector<dvec3> velocities(problem.initial.velocities.begin(),
                                problem.initial.velocities.end());
  for (int k = 0; k < count; ++k) {
    const SphNeighbourLists lists =
        sph_neighbours(now.initial.positions, now.boundary, float(now.parameters.support));
    velocities = kicked(now, lists, velocities, step);
    for (std::size_t i = 0; i < velocities.size(); ++i) {
      positions[i] += step * velocities[i];
      now.initial.positions[i] = vec3(positions[i]);
      now.initial.velocities[i] = vec3(velocities[i]);
    }
  }
  now.initial.time += step * count;
  return now.initial;
}

double sph_stable_step(const SphParameters& p) {
  constexpr int waves = 24;
  const int waves_z = p.dimensions == 3 ? waves : 0;
  double smallest = 1e30;
  for (int z = 0; z <= waves_z; ++z)
    for (int y = 0; y <= waves; ++y)
      for (int x = 0; x <= waves; ++x) {
        const Rates rates = rates_of(p, std::numbers::pi / p.spacing / waves * dvec3(x, y, z));
        const double w2 = std::pow(rates.wave * p.sound_speed, 2);
        const double g = rates.friction;
        const double root = std::sqrt(g * g + 4 * w2);
        if (!p.implicit_viscosity && w2 + g > 0) smallest = std::min(smallest, 4 / (g + root));
        if (p.implicit_viscosity && w2 > 0) smallest = std::min(smallest, (g + root) / w2);
      }
  return smallest;
}

}  // namespace parity::cpu
