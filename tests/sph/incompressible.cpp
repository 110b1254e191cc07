#include "cpu_reference/sph/pressure.h"
#include "cpu_reference/sph/step.h"
#include "gpu/sph/step.h"
#include "tests/compare.h"
#include "tests/sph/problems.h"

namespace parity {
namespace {

constexpr int rounds = 6, steps = 3;

SphProblem problem_of(const Setting& setting) {
  SphProblem problem = sph_test::tank_of(setting);
  SphParameters& p = problem.parameters;
  // A fifth as far off the lattice: what is pressed out of one another by half a spacing in one
  // step goes where rounding sends it.
  const SphProblem still = sph_hydrostatic_column(p.dimensions, 0.5, 0.5, setting.count("across"));
  for (std::size_t i = 0; i < still.initial.positions.size(); ++i)
    problem.initial.positions[i] =
        glm::mix(still.initial.positions[i], problem.initial.positions[i], 0.2f);
  p.method =
      setting.count("divergence") != 0 ? SphMethod::divergence_free : SphMethod::constant_density;
  p.implicit_viscosity = setting.count("implicit") != 0;
  p.viscosity_error = 1e-7;
  p.fixed_step = 0.2 * p.spacing / p.sound_speed;
  p.density_error = 1e-7;  // never met in so few rounds
  p.max_iterations = rounds;
  return problem;
}

SphState on_device(gpu::Context& context, const SphProblem& problem) {
  gpu::SphStep step(context, problem);
  context.run([&](gpu::Commands& commands) {
    for (int k = 0; k < steps; ++k) step.record(commands, 1e9);
  });
  return step.read();
}

/// That of velocities after one step, as for sph/pressure, goes on for the steps that follow, and a
/// step of a fifth of a spacing over the speed of sound enlarges it by no more than 4.
double tolerance(const SphProblem& problem) {
  const SphParameters& p = problem.parameters;
  const SphNeighbourLists lists = cpu::sph_neighbours(problem);
  const std::vector<double> densities = cpu::sph_densities(problem, lists);
  double speed = 0;
  for (const dvec3& v : cpu::sph_incompressible_velocities(problem).velocities)
    speed = std::max(speed, glm::length(v));
  const double closing = sph_test::density_bound(problem, lists, densities) / p.rest_density *
                         p.support / p.fixed_step;
  const double off =
      2 * rounds * (closing + 64 * sph_test::u * sph_test::most_neighbours(lists) * speed);
  return 4 * steps *
         (2 * sph_test::u * glm::length(problem.domain.high) + steps * p.fixed_step * off);
}

/// Below 1.5 spacings of support a particle alone is denser than the fluid at rest, and no pressure
/// can help it.
std::vector<Axis> axes() {
  std::vector<Axis> axes = sph_test::tank_axes();
  axes[3].low = 1.6;
  axes.push_back(
      {.name = "divergence", .low = 0, .high = 1, .standard = 1, .whole = true, .each = true});
  axes.push_back(
      {.name = "implicit", .low = 0, .high = 1, .standard = 0, .whole = true, .each = true});
  return axes;
}

const Registration registration = register_stage<SphProblem, SphState>({
    .name = "sph/incompressible",
    .title = "Incompressible steps of a stirred tank",
    .source = "notes 10.1, 10.4; Bender & Koschier 2015, 2017",
    .rows = {160, 168},
    .axes = axes(),
    .problem = problem_of,
    .cpu = {{.solve =
                 [](const SphProblem& p) {
                   return cpu::sph_step(p, p.parameters.fixed_step, steps);
                 }}},
    .gpu = {{.name = "lists", .solve = on_device}},
    .distance =
        [](const SphState& got, const SphState& want) {
          return largest_difference(got.positions, want.positions);
        },
    .tolerance = tolerance,
    .why = "3 steps of twice 6 rounds: velocities are off as those of sph/pressure in each, which "
           "lasts; neither grows by more than 4 in steps of a fifth of a spacing over the speed of "
           "sound",
});

}  // namespace
}  // namespace parity
