#include "cpu_reference/sph/gradient.h"

#include "gpu/sph/gradient.h"
#include "tests/compare.h"
#include "tests/sph/problems.h"

namespace parity {
namespace {

using Columns = std::vector<dvec3>;

template <typename Matrix>
Columns columns_of(const std::vector<Matrix>& gradients) {
  Columns columns;
  for (const Matrix& gradient : gradients)
    for (int k = 0; k < 3; ++k) columns.emplace_back(gradient[k]);
  return columns;
}

/// Changes of velocity over the distances at which they count, n terms of each, good to 40 u; the
/// inverse enlarges that by no more than the mean of the moments over the least that they may have
/// in any direction, which is 20 / 4 with two of them at most 1.5 times the mean.
double tolerance(const SphProblem& problem) {
  const SphParameters& p = problem.parameters;
  const double n = sph_test::most_neighbours(cpu::sph_neighbours(problem));
  const double change = 2 * std::sqrt(3.0) * 0.1 * p.sound_speed;
  return 40 * sph_test::u * n * 20 * change / (0.25 * p.spacing);
}

const Registration registration = register_stage<SphProblem, Columns>({
    .name = "sph/gradient",
    .title = "Velocity gradients by kernels that are exact for linear fields",
    .source = "notes 10.4; Randles & Libersky 1996; Bonet & Lok 1999",
    .rows = {168},
    .axes = sph_test::tank_axes(),
    .problem = sph_test::tank_of,
    .cpu = {{.solve =
                 [](const SphProblem& p) {
                   const SphNeighbourLists lists = cpu::sph_neighbours(p);
                   return columns_of(
                       cpu::sph_velocity_gradients(p, lists, cpu::sph_densities(p, lists)));
                 }}},
    .gpu = {{.name = "lists",
             .solve =
                 [](gpu::Context& context, const SphProblem& p) {
                   return columns_of(gpu::sph_velocity_gradients(context, p));
                 }}},
    .distance = [](const Columns& got,
                   const Columns& want) { return largest_difference(got, want); },
    .tolerance = tolerance,
    .why = "n changes of velocity over a quarter of a spacing or more, good to 40 u, times the "
           "factor of 20 that moments as flat as are allowed may add",
});

}  // namespace
}  // namespace parity
