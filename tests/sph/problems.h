#pragma once

#include <algorithm>
#include <cmath>
#include <tuple>

#include "cpu_reference/sph/density.h"
#include "cpu_reference/sph/kernel.h"
#include "cpu_reference/sph/neighbours.h"
#include "geometry/random.h"
#include "sim/sph.h"
#include "tests/setting.h"
#include "tests/stage.h"

/// Problems of particle fluids for stages and tests, and how far rounding carries.
namespace parity {

inline auto fields_of(const SphParameters*) {
  using P = SphParameters;
  return std::tuple{&P::dimensions,
                    &P::spacing,
                    &P::support,
                    &P::kernel,
                    &P::method,
                    &P::equation_of_state,
                    &P::rest_density,
                    &P::sound_speed,
                    &P::artificial_viscosity,
                    &P::viscosity,
                    &P::surface_tension,
                    &P::gravity,
                    &P::fixed_step,
                    &P::implicit_viscosity};
}
inline auto fields_of(const SphState*) {
  return std::tuple{&SphState::time, &SphState::positions, &SphState::velocities};
}
inline auto fields_of(const SphBox*) { return std::tuple{&SphBox::low, &SphBox::high}; }
inline auto fields_of(const SphProblem*) {
  return std::tuple{&SphProblem::parameters, &SphProblem::initial, &SphProblem::boundary,
                    &SphProblem::boundary_motions, &SphProblem::domain};
}
inline auto fields_of(const SphNeighbourLists*) {
  return std::tuple{&SphNeighbourLists::fluid, &SphNeighbourLists::walls};
}

namespace sph_test {

constexpr double u = 0x1p-24;

/// A tank half full of particles off their lattice by up to a quarter spacing, with random
/// velocities of up to a tenth of the sound speed, and with both viscosities and surface tension.
inline SphProblem stirred_tank(std::uint32_t dimensions, int count, SphKernel kernel,
                               double support_ratio, SphEquationOfState equation,
                               std::uint64_t seed) {
  SphProblem problem = sph_hydrostatic_column(dimensions, 0.5, 0.5, count);
  SphParameters& p = problem.parameters;
  p.kernel = kernel;
  p.support = support_ratio * p.spacing;
  p.equation_of_state = equation;
  p.viscosity = 0.01 * p.sound_speed * p.spacing;
  p.surface_tension = 5;
  Random random{seed};
  for (std::size_t i = 0; i < problem.initial.positions.size(); ++i) {
    vec3 shift = random.in_box(float(0.25 * p.spacing));
    vec3 velocity = random.in_box(float(0.1 * p.sound_speed));
    if (dimensions == 2) shift.z = velocity.z = 0;
    problem.initial.positions[i] += shift;
    problem.initial.velocities[i] = velocity;
  }
  return problem;
}

inline std::vector<Axis> tank_axes() {
  return {{.name = "across", .low = 1, .high = 12, .standard = 7, .whole = true},
          {.name = "dimensions", .low = 2, .high = 3, .standard = 3, .whole = true, .each = true},
          {.name = "kernel", .low = 0, .high = 3, .standard = 0, .whole = true, .each = true},
          {.name = "support", .unit = "spacings", .low = 1.2, .high = 3.2, .standard = 2},
          {.name = "equation", .low = 0, .high = 1, .standard = 1, .whole = true, .each = true}};
}

inline SphProblem tank_of(const Setting& setting) {
  return stirred_tank(std::uint32_t(setting.count("dimensions")), setting.count("across"),
                      SphKernel(setting.count("kernel")), setting.at("support"),
                      SphEquationOfState(setting.count("equation")), setting.seed);
}

/// Most neighbours of a particle, walls too, and itself.
inline double most_neighbours(const SphNeighbourLists& lists) {
  std::size_t most = 0;
  for (std::size_t i = 0; i < lists.fluid.size(); ++i)
    most = std::max(most, lists.fluid[i].size() + lists.walls[i].size() + 1);
  return double(most);
}

/// How far a density in float may be off, kg/m^3: r is good to 4 u of the support, a profile's
/// slope is at most 3 and its own operations add 8 u; the walls' volumes are sums of as many terms;
/// n terms add up with n u of the sum.
inline double density_bound(const SphProblem& problem, const SphNeighbourLists& lists,
                            const std::vector<double>& densities) {
  const SphParameters& p = problem.parameters;
  const double n = most_neighbours(lists);
  const double peak = p.rest_density * std::pow(p.spacing, int(p.dimensions)) *
                      cpu::sph_kernel(p.kernel, p.dimensions, 0, p.support);
  double largest = 0;
  for (const double density : densities) largest = std::max(largest, density);
  return u * (20 * n * peak + (2 * n + 30) * largest);
}

/// How far an acceleration in float may be off, m/s^2: the densities' bound through the pressure's
/// slope, and 40 u of each term at its largest, n of them.
inline double acceleration_bound(const SphProblem& problem) {
  const SphParameters& p = problem.parameters;
  const SphNeighbourLists lists = cpu::sph_neighbours(problem);
  const std::vector<double> densities = cpu::sph_densities(problem, lists);
  const double n = most_neighbours(lists);
  const double off = density_bound(problem, lists, densities);
  double pressure = 0, slope = 0, least = 1e30;
  for (const double density : densities) {
    const double stiff = p.equation_of_state == SphEquationOfState::tait
                             ? std::pow(std::max(1.0, density / p.rest_density), 6)
                             : 1.0;
    pressure = std::max(pressure, cpu::sph_pressure(p, density) / (density * density));
    slope = std::max(slope, p.sound_speed * p.sound_speed * stiff / (density * density));
    least = std::min(least, density);
  }
  // No profile is steeper than 3.
  const double peak = 3 / p.support * cpu::sph_kernel(p.kernel, p.dimensions, 0, p.support);
  double speed = 0;
  for (const vec3& v : problem.initial.velocities)
    speed = std::max(speed, 2.0 * double(glm::length(v)));
  const double h = p.support / 2;
  const double friction =
      (2 * (p.dimensions + 2) * p.viscosity + p.artificial_viscosity * p.sound_speed * h) * speed;
  // A wall stands for at most the volume that its own kernel value leaves it.
  const double mass = std::max(
      particle_mass(p), p.rest_density / cpu::sph_kernel(p.kernel, p.dimensions, 0, p.support));
  // |d / (r^2 + eps)| is at most 1 / (0.2 h).
  const double term = mass * 2 * pressure * peak + mass / least * friction / (0.2 * h) * peak +
                      p.surface_tension * p.support;
  return n * (2 * mass * slope * off * peak + 60 * u * term) +
         n * mass / least * friction / (0.2 * h) * peak * off / least +
         2 * u * glm::length(p.gravity);
}

/// Largest energy at eight times of a run: motion, height above the lowest corner, compression;
/// 1e30 if it breaks down.
double peak_energy(gpu::Context& context, const SphProblem& problem);

/// That over the same of adaptive steps a quarter as long.
double energy_over_finer(gpu::Context& context, const SphProblem& problem);

/// The most that energy_over_finer may be of a stable run. Kick and drift keep not the energy of a
/// wave, E = (v^2 + w^2 x^2) / 2, but E - dt w^2 x v / 2, so E stays within (1 + q) / (1 - q) of
/// what it was, q = w dt / 2; an adaptive step keeps q within its Courant number for the fastest
/// wave of all, and friction only takes. The finer run may be as much too low at a quarter of that.
double energy_bound(double courant);

/// A column's pressure after it has come to rest, averaged over layers and over a period of its
/// bounce.
struct Column {
  std::vector<double> depths;     ///< m, of the layers
  std::vector<double> pressures;  ///< Pa
  double error = 0;  ///< RMS over layers against the weight above, in pressures at the floor
};
Column settle_column(gpu::Context& context, const SphProblem& problem);

/// A box without gravity in 2 dimensions, full of fluid 1 % too dense, so that it has pressure
/// everywhere, walls on all sides, and random velocities of 1e-4 of the sound speed.
SphProblem closed_box(int across, double sound_speed, double viscosity);

/// Fluid on its lattice between two walls, `rows` of particles across, twelve times as long, its
/// ends free; without waves, as the speed of sound is next to nothing; the upper wall slides at
/// `speed`. The walls' particles, which do not slip, stand rows + 1 spacings apart, which are 1 m.
SphProblem channel(int rows, double speed);

/// What shear along the rows of a channel on its lattice meets, over the viscosity asked for: rows
/// are tied to the next rows alone, and the sums are this times (u(+1) - 2 u + u(-1)) / s^2.
double lattice_viscosity(const SphParameters& parameters);

/// Mean velocity along the channel of each row's two particles in the middle.
std::vector<double> profile_of(const SphProblem& channel, const SphState& state);

/// s, the largest step that an explicit viscosity could take at rest.
double viscous_step(const SphParameters& parameters);

/// Largest speed after so many steps of the fixed length over that at the start; 1e30 beyond that.
double speed_growth(gpu::Context& context, const SphProblem& problem, int steps);

}  // namespace sph_test
}  // namespace parity
