#include "gpu/sph/constants.h"

#include <cmath>
#include <numbers>

namespace parity::gpu {
namespace {

constexpr double pi = std::numbers::pi;

/// The kernel's profile, 1 at q = 0 and 0 at q = 1.
double profile(SphKernel kernel, double q) {
  const double t = 1 - q;
  switch (kernel) {
    case SphKernel::cubic_spline:
      return q < 0.5 ? 1 - 6 * q * q * t : 2 * t * t * t;
    case SphKernel::poly6:
      return std::pow(1 - q * q, 3);
    case SphKernel::spiky:
      return t * t * t;
    case SphKernel::wendland:
      return t * t * t * t * (1 + 4 * q);
  }
  return 0;
}

/// 1 / integral of the profile over the unit disc or ball. Source: notes 10.4 and the papers named
/// in kernel.glsl.
double normalisation(SphKernel kernel, bool solid) {
  switch (kernel) {
    case SphKernel::cubic_spline:
      return solid ? 8 / pi : 40 / (7 * pi);
    case SphKernel::poly6:
      return solid ? 315 / (64 * pi) : 4 / pi;
    case SphKernel::spiky:
      return solid ? 15 / pi : 10 / pi;
    case SphKernel::wendland:
      return solid ? 21 / (2 * pi) : 7 / pi;
  }
  return 0;
}

/// Integral of |W'| r^-power over space.
double slope_integral(const SphParameters& p, double scale, int power) {
  constexpr int steps = 1000;
  const int d = int(p.dimensions);
  double sum = 0;
  for (int k = 0; k < steps; ++k) {
    const double low = double(k) / steps;
    const double high = double(k + 1) / steps;
    sum += std::abs(profile(p.kernel, high) - profile(p.kernel, low)) *
           std::pow(0.5 * (low + high), d - 1 - power);
  }
  return scale * (d == 3 ? 4 : 2) * pi * std::pow(p.support, d - 1 - power) * sum;
}

/// Sum of the profile over a row or plane of the lattice that is `layer` spacings away.
double layer_sum(const SphParameters& p, int layer) {
  const int reach = int(std::ceil(p.support / p.spacing));
  const int reach_z = p.dimensions == 3 ? reach : 0;
  double sum = 0;
  for (int z = -reach_z; z <= reach_z; ++z)
    for (int x = -reach; x <= reach; ++x) {
      const double q = p.spacing * std::sqrt(double(x * x + z * z + layer * layer)) / p.support;
      if (q < 1) sum += profile(p.kernel, q);
    }
  return sum;
}

/// Of the volume of a wall particle, so that fluid a spacing from a flat wall is at rest density:
/// one layer stands for all that the lattice would have behind it.
double wall_share(const SphParameters& p, double scale, double volume) {
  double behind = 0;
  for (int layer = 1; layer * p.spacing < p.support; ++layer) behind += layer_sum(p, layer);
  const double alone = layer_sum(p, 1) / (layer_sum(p, 0) * scale);
  return alone > 0 ? behind * volume / alone : 0;
}

/// `reach`: cells of a support along y and z; along x it is 2 cells.
SphGrid grid_of(const SphProblem& problem, int reach) {
  const SphParameters& p = problem.parameters;
  const bool solid = p.dimensions == 3;
  SphGrid grid;
  const dvec3 margin{p.support, p.support, solid ? p.support : 0};
  const dvec3 sides = problem.domain.high - problem.domain.low + 2.0 * margin;
  grid.low = vec3(problem.domain.low - margin);
  const dvec3 parts = dvec3(2, reach, reach) / p.support;
  grid.inverse_cell = vec3(parts);
  grid.cells = uvec3(glm::ceil(sides * parts));
  if (!solid) {
    grid.low.z = 0;
    grid.cells.z = 1;
  }
  grid.reach = reach;
  grid.reach_z = solid ? reach : 0;
  return grid;
}

}  // namespace

SphConstants sph_constants(const SphProblem& problem) {
  check_sph_problem(problem);
  const SphParameters& p = problem.parameters;
  const double d = p.dimensions;
  const double volume = std::pow(p.spacing, d);
  const double scale = normalisation(p.kernel, p.dimensions == 3) / std::pow(p.support, d);
  const double friction = 2 * (d + 2) * p.viscosity;
  const double laminar = p.implicit_viscosity ? 0 : friction;
  const bool stiff = p.method == SphMethod::weakly_compressible;
  const double sound = stiff ? p.sound_speed : 0;
  const double artificial = p.artificial_viscosity * sound * p.support / 2;
  const double ball = d == 3 ? 4 * pi / 3 : pi;
  SphConstants c{};
  c.grid = grid_of(problem, 2);
  c.wall_grid = grid_of(problem, 1);
  c.gravity = vec3(p.gravity);
  c.support = float(p.support);
  c.inverse_support = float(1 / p.support);
  c.kernel_scale = float(scale);
  c.mass = float(particle_mass(p));
  c.rest_density = float(p.rest_density);
  c.sound_speed = float(p.sound_speed);
  c.laminar = float(laminar);
  c.implicit = float(friction - laminar);
  c.artificial = float(artificial);
  c.tension = float(p.surface_tension * volume);
  c.softening = float(0.01 * p.support * p.support / 4);
  c.wall_share = float(wall_share(p, scale, volume));
  c.wave_rate = float(slope_integral(p, scale, 0));
  c.viscous_rate = float(2 * (laminar + artificial) / d * slope_integral(p, scale, 1));
  c.tension_rate = float(2 * p.surface_tension * (1 + d));
  c.courant = float(p.courant);
  c.fixed_step = float(p.fixed_step);
  c.max_step = float(p.max_step);
  c.dimensions = float(d);
  c.tait = p.equation_of_state == SphEquationOfState::tait ? 1 : 0;
  c.stiff = stiff ? 1 : 0;
  c.count = std::uint32_t(problem.initial.positions.size());
  c.boundary_count = std::uint32_t(problem.boundary.size());
  c.capacity = std::uint32_t(1.8 * ball * std::pow(p.support / p.spacing, d)) + 12;
  return c;
}

}  // namespace parity::gpu
