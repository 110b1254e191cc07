#include "cpu_reference/sph/viscosity.h"

#include "gpu/sph/viscosity.h"
#include "tests/compare.h"
#include "tests/sph/problems.h"

namespace parity {
namespace {

/// The step is `stiffness` times the largest that an explicit one could take; walls slide.
SphProblem problem_of(const Setting& setting) {
  SphProblem problem = sph_test::tank_of(setting);
  SphParameters& p = problem.parameters;
  p.implicit_viscosity = true;
  p.viscosity_error = 1e-6;
  p.max_iterations = 300;
  p.fixed_step = setting.at("stiffness") * sph_test::viscous_step(p);
  const double speed = 0.1 * p.sound_speed;
  for (const vec3& wall : problem.boundary)
    problem.boundary_motions.emplace_back(wall.y > 0 ? speed : 0, 0, 0, wall.x > 0 ? 1 : 0.25);
  return problem;
}

std::vector<dvec3> reference(const SphProblem& problem) {
  const SphNeighbourLists lists = cpu::sph_neighbours(problem);
  const std::vector<dvec3> velocities(problem.initial.velocities.begin(),
                                      problem.initial.velocities.end());
  return cpu::sph_viscous_velocities(problem, lists, cpu::sph_densities(problem, lists), velocities,
                                     problem.parameters.fixed_step);
}

/// The largest error of one particle is at most root n times the RMS error that the solver leaves;
/// a product with the matrix rounds n terms, each up to twice the stiffness times the speed.
double tolerance(const SphProblem& problem) {
  const SphParameters& p = problem.parameters;
  const SphNeighbourLists lists = cpu::sph_neighbours(problem);
  const double stiffness = p.fixed_step / sph_test::viscous_step(p);
  const double speed = 0.1 * std::sqrt(3.0) * p.sound_speed;
  const double n = sph_test::most_neighbours(lists);
  const double rounding = 16 * sph_test::u * n * (1 + 2 * stiffness);
  return speed * (p.viscosity_error * std::sqrt(double(lists.fluid.size())) + rounding);
}

std::vector<Axis> axes() {
  std::vector<Axis> axes = sph_test::tank_axes();
  axes.push_back(
      {.name = "stiffness", .low = 0.1, .high = 100, .standard = 5, .logarithmic = true});
  return axes;
}

const Registration registration = register_stage<SphProblem, std::vector<dvec3>>({
    .name = "sph/viscosity",
    .title = "An implicit step of viscosity between particles and sliding walls",
    .source = "notes 10.1, 10.4; Weiler et al. 2018; Monaghan 2005",
    .rows = {168},
    .axes = axes(),
    .problem = problem_of,
    .cpu = {{.solve = reference}},
    .gpu = {{.name = "conjugate gradients",
             .solve =
                 [](gpu::Context& context, const SphProblem& p) {
                   const auto result = gpu::sph_viscous_velocities(context, p);
                   return std::vector<dvec3>(result.velocities.begin(), result.velocities.end());
                 }}},
    .distance = [](const std::vector<dvec3>& got,
                   const std::vector<dvec3>& want) { return largest_difference(got, want); },
    .tolerance = tolerance,
    .why = "all eigenvalues are at least 1, so the error is at most the residual where the solver "
           "stops, 1e-6 RMS, and root n times that for one particle; n terms of up to twice the "
           "stiffness round with 16 u",
});

}  // namespace
}  // namespace parity
