#include "cpu_reference/sph/step.h"
#include "gpu/sph/step.h"
#include "tests/sph/problems.h"

namespace parity::sph_test {
namespace {

/// Above its lowest possible height.
double height_energy(const SphProblem& problem, const SphMeasures& measures) {
  const SphParameters& p = problem.parameters;
  double lowest = 0;
  for (int k = 0; k < 3; ++k)
    lowest -= measures.mass * std::max(p.gravity[k] * (problem.domain.low[k] - p.spacing),
                                       p.gravity[k] * (problem.domain.high[k] + p.spacing));
  return measures.potential_energy - lowest;
}

/// What lies in the compression of the fluid: integral of p / rho^2 from rest.
double compression_energy(const SphParameters& p, std::span<const float> densities) {
  double energy = 0;
  for (const float density : densities) {
    const double end = std::max(double(density), p.rest_density);
    const double middle = (end + p.rest_density) / 2;
    const auto push = [&](double rho) { return cpu::sph_pressure(p, rho) / (rho * rho); };
    energy += particle_mass(p) * (end - p.rest_density) / 6 * (4 * push(middle) + push(end));
  }
  return energy;
}

}  // namespace

double peak_energy(gpu::Context& context, const SphProblem& problem) {
  constexpr int looks = 8;
  const SphParameters& p = problem.parameters;
  gpu::SphStep step(context, problem);
  double peak = 0;
  try {
    for (int k = 1; k <= looks; ++k) {
      gpu::advance(context, step, problem.duration * k / looks, 20000);
      const SphMeasures measures = measure(p, step.read());
      const double energy = measures.kinetic_energy + height_energy(problem, measures) +
                            compression_energy(p, step.densities().read());
      if (!std::isfinite(energy)) return 1e30;
      peak = std::max(peak, energy);
    }
  } catch (const gpu::Error&) {
    return 1e30;
  }
  return peak;
}

double energy_over_finer(gpu::Context& context, const SphProblem& problem) {
  SphProblem finer = problem;
  finer.parameters.fixed_step = 0;
  finer.parameters.courant /= 4;
  return std::min(peak_energy(context, problem) / peak_energy(context, finer), 1e4);
}

double energy_bound(double courant) {
  return (1 + courant) / (1 - courant) * (1 + courant / 4) / (1 - courant / 4);
}

Column settle_column(gpu::Context& context, const SphProblem& problem) {
  const SphParameters& p = problem.parameters;
  const double height = measure(p, problem.initial).high.y + p.spacing / 2;
  const double floor_pressure = -p.rest_density * p.gravity.y * height;
  const auto layers = std::size_t(std::lround(height / p.spacing));
  const double period = 4 * height / p.sound_speed;
  constexpr int samples = 12;
  std::vector<double> count(layers);
  Column column{std::vector<double>(layers), std::vector<double>(layers)};
  gpu::SphStep step(context, problem);
  for (int k = 1; k <= samples; ++k) {
    gpu::advance(context, step, (3 + double(k) / samples) * period, 1000000);
    const SphState state = step.read();
    const std::vector<float> pressures = step.pressures().read();
    for (std::size_t i = 0; i < pressures.size(); ++i) {
      const double y = state.positions[i].y;
      const auto layer = std::min(layers - 1, std::size_t(std::max(0.0, y / p.spacing)));
      column.pressures[layer] += pressures[i];
      column.depths[layer] += height - y;
      count[layer] += 1;
    }
  }
  for (std::size_t k = 0; k < layers; ++k) {
    column.pressures[k] /= count[k];
    column.depths[k] /= count[k];
    const double want = floor_pressure * column.depths[k] / height;
    column.error += std::pow((column.pressures[k] - want) / floor_pressure, 2);
  }
  column.error = std::sqrt(column.error / double(layers));
  return column;
}

SphProblem closed_box(int across, double sound_speed, double viscosity) {
  SphProblem problem;
  SphParameters& p = problem.parameters;
  p.dimensions = 2;
  p.spacing = 1.0 / across;
  p.support = 2 * p.spacing;
  p.equation_of_state = SphEquationOfState::linear;
  p.sound_speed = sound_speed;
  p.viscosity = viscosity;
  p.artificial_viscosity = 0;
  p.gravity = dvec3(0);
  // Half a per cent less room each way.
  const double spacing = 0.995 * p.spacing;
  problem.domain = {dvec3(0), dvec3(spacing * across, spacing * across, 0)};
  problem.initial.positions = fill_box(problem.domain, spacing, 2);
  problem.boundary = cover_box(problem.domain, spacing, 2, true, false);
  problem.domain.high += dvec3(p.spacing, p.spacing, 0);
  Random random{1};
  for (std::size_t i = 0; i < problem.initial.positions.size(); ++i) {
    vec3 velocity = random.in_box(float(1e-4 * sound_speed));
    velocity.z = 0;
    problem.initial.velocities.push_back(velocity);
  }
  return problem;
}

SphProblem channel(int rows, double speed) {
  SphProblem problem;
  SphParameters& p = problem.parameters;
  p.dimensions = 2;
  p.spacing = 1.0 / (rows + 1);
  p.support = 2 * p.spacing;
  p.sound_speed = 1e-6;
  p.artificial_viscosity = 0;
  p.gravity = dvec3(0);
  p.viscosity = 1;
  p.implicit_viscosity = true;
  const int columns = 12 * (rows + 1);
  problem.domain = {dvec3(0), p.spacing * dvec3(columns, rows, 0)};
  problem.initial.positions = fill_box(problem.domain, p.spacing, 2);
  problem.initial.velocities.resize(problem.initial.positions.size());
  for (int side = 0; side < 2; ++side)
    for (int x = -2; x < columns + 2; ++x) {
      problem.boundary.emplace_back(p.spacing * dvec3(x + 0.5, side == 0 ? -0.5 : rows + 0.5, 0));
      problem.boundary_motions.emplace_back(side == 0 ? 0 : speed, 0, 0, 1);
    }
  return problem;
}

double lattice_viscosity(const SphParameters& p) {
  // Of the neighbours in the next row only those two on the diagonals feel shear.
  const double r = std::sqrt(2.0) * p.spacing, h = p.support / 2;
  const double slope = cpu::sph_kernel_derivative(p.kernel, 2, r, p.support);
  double density = 0;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x)
      density += p.spacing * p.spacing *
                 cpu::sph_kernel(p.kernel, 2, p.spacing * std::hypot(x, y), p.support);
  return -2 * 8 * std::pow(p.spacing, 6) / density * slope / r / (r * r + 0.01 * h * h);
}

std::vector<double> profile_of(const SphProblem& channel, const SphState& state) {
  const double spacing = channel.parameters.spacing;
  std::vector<double> profile(std::size_t(std::lround(channel.domain.high.y / spacing)));
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    const vec3& start = channel.initial.positions[i];
    if (std::abs(start.x - channel.domain.high.x / 2) < spacing)
      profile[std::size_t(start.y / spacing)] += double(state.velocities[i].x) / 2;
  }
  return profile;
}

double viscous_step(const SphParameters& parameters) {
  SphParameters p = parameters;
  p.implicit_viscosity = false;
  p.sound_speed = 1e-6;
  return cpu::sph_stable_step(p);
}

double speed_growth(gpu::Context& context, const SphProblem& problem, int steps) {
  gpu::SphStep step(context, problem);
  context.run([&](gpu::Commands& commands) {
    for (int k = 0; k < steps; ++k) step.record(commands, 1e9);
  });
  const double growth = measure(problem.parameters, step.read()).max_speed /
                        measure(problem.parameters, problem.initial).max_speed;
  return std::isfinite(growth) ? std::min(growth, 1e30) : 1e30;
}

}  // namespace parity::sph_test
