#include "cpu_reference/sph/pressure.h"

#include "gpu/sph/pressure.h"
#include "tests/compare.h"
#include "tests/sph/problems.h"

namespace parity {
namespace {

constexpr int rounds = 8;

SphProblem problem_of(const Setting& setting) {
  SphProblem problem = sph_test::tank_of(setting);
  SphParameters& p = problem.parameters;
  p.method =
      setting.count("divergence") != 0 ? SphMethod::divergence_free : SphMethod::constant_density;
  p.fixed_step = p.spacing / p.sound_speed;
  p.density_error = 1e-7;  // never met in so few rounds
  p.max_iterations = rounds;
  return problem;
}

std::vector<Axis> axes() {
  std::vector<Axis> axes = sph_test::tank_axes();
  axes.push_back(
      {.name = "divergence", .low = 0, .high = 1, .standard = 1, .whole = true, .each = true});
  return axes;
}

/// In each round velocities are sums of n terms, and the density's bound asks for as much velocity
/// as closes it over a support in a step.
double tolerance(const SphProblem& problem) {
  const SphParameters& p = problem.parameters;
  const SphNeighbourLists lists = cpu::sph_neighbours(problem);
  const std::vector<double> densities = cpu::sph_densities(problem, lists);
  double speed = 0;
  for (const dvec3& v : cpu::sph_incompressible_velocities(problem).velocities)
    speed = std::max(speed, glm::length(v));
  for (const vec3& v : problem.initial.velocities) speed = std::max(speed, double(glm::length(v)));
  const double closing = sph_test::density_bound(problem, lists, densities) / p.rest_density *
                         p.support / p.fixed_step;
  return 2 * rounds * (closing + 64 * sph_test::u * sph_test::most_neighbours(lists) * speed);
}

const Registration registration = register_stage<SphProblem, std::vector<dvec3>>({
    .name = "sph/pressure",
    .title = "Velocities under which no particle is compressed",
    .source = "notes 10.4; Bender & Koschier 2015, 2017; Ihmsen et al. 2014",
    .rows = {168},
    .axes = axes(),
    .problem = problem_of,
    .cpu = {{.solve =
                 [](const SphProblem& p) {
                   return cpu::sph_incompressible_velocities(p).velocities;
                 }}},
    .gpu = {{.name = "lists",
             .solve =
                 [](gpu::Context& context, const SphProblem& p) {
                   const std::vector<vec3> v = gpu::sph_incompressible_velocities(context, p);
                   return std::vector<dvec3>(v.begin(), v.end());
                 }}},
    .distance = [](const std::vector<dvec3>& got,
                   const std::vector<dvec3>& want) { return largest_difference(got, want); },
    .tolerance = tolerance,
    .why =
        "twice 8 rounds of half Jacobi steps, which do not enlarge errors; in each, 64 n u of the "
        "largest speed, and the velocity that closes the densities' bound over a support",
});

}  // namespace
}  // namespace parity
