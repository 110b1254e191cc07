#include "cpu_reference/sph/step.h"

#include "gpu/sph/step.h"
#include "tests/compare.h"
#include "tests/sph/problems.h"

namespace parity {
namespace {

constexpr int steps = 5;

SphProblem problem_of(const Setting& setting) {
  SphProblem problem = sph_test::tank_of(setting);
  problem.parameters.fixed_step = 0.2 * cpu::sph_stable_step(problem.parameters);
  problem.parameters.implicit_viscosity = setting.count("implicit") != 0;
  problem.parameters.viscosity_error = 1e-7;
  return problem;
}

std::vector<Axis> axes() {
  std::vector<Axis> axes = sph_test::tank_axes();
  axes.push_back(
      {.name = "implicit", .low = 0, .high = 1, .standard = 0, .whole = true, .each = true});
  return axes;
}

SphState on_device(gpu::Context& context, const SphProblem& problem) {
  gpu::SphStep step(context, problem);
  context.run([&](gpu::Commands& commands) {
    for (int k = 0; k < steps; ++k) step.record(commands, 1e9);
  });
  return step.read();
}

double distance(const SphState& got, const SphState& want) {
  return largest_difference(got.positions, want.positions);
}

/// Each step adds the rounding of a position and of a kick; errors of velocity last.
double tolerance(const SphProblem& problem) {
  const double dt = problem.parameters.fixed_step;
  const double kick = dt * dt * 2 * sph_test::acceleration_bound(problem);
  return 4 * steps * (2 * sph_test::u * glm::length(problem.domain.high) + steps * kick);
}

const Registration registration = register_stage<SphProblem, SphState>({
    .name = "sph/step",
    .title = "Weakly compressible steps of a stirred tank",
    .source = "notes 10.1, 10.4; Monaghan 1992",
    .rows = {160, 168},
    .axes = axes(),
    .problem = problem_of,
    .cpu = {{.solve =
                 [](const SphProblem& p) {
                   return cpu::sph_step(p, p.parameters.fixed_step, steps);
                 }}},
    .gpu = {{.name = "lists", .solve = on_device}},
    .distance = distance,
    .tolerance = tolerance,
    .why = "5 steps: each rounds positions by 2 u of the domain and kicks by twice the forces' "
           "bound, and a wrong velocity goes on; at a fifth of the stable step neither grows by "
           "more than a factor of 4",
});

}  // namespace
}  // namespace parity
