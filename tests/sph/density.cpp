#include "cpu_reference/sph/density.h"

#include "gpu/sph/density.h"
#include "tests/compare.h"
#include "tests/sph/problems.h"

namespace parity {
namespace {

std::vector<double> reference(const SphProblem& problem) {
  return cpu::sph_densities(problem, cpu::sph_neighbours(problem));
}

const Registration registration = register_stage<SphProblem, std::vector<double>>({
    .name = "sph/density",
    .title = "Density of particles by kernels, walls included",
    .source = "notes 10.4; Akinci et al. 2012",
    .rows = {168},
    .axes = sph_test::tank_axes(),
    .problem = sph_test::tank_of,
    .cpu = {{.solve = reference}},
    .gpu = {{.name = "lists",
             .solve =
                 [](gpu::Context& context, const SphProblem& p) {
                   const std::vector<float> densities = gpu::sph_densities(context, p);
                   return std::vector<double>(densities.begin(), densities.end());
                 }}},
    .distance = [](const std::vector<double>& got,
                   const std::vector<double>& want) { return largest_difference(got, want); },
    .tolerance =
        [](const SphProblem& p) {
          const SphNeighbourLists lists = cpu::sph_neighbours(p);
          return sph_test::density_bound(p, lists, cpu::sph_densities(p, lists));
        },
    .why = "r is good to 4 u of the support, profiles have slopes up to 3 and 8 operations, the "
           "walls' volumes are sums of n terms, and n terms add up with n u of the sum",
});

}  // namespace
}  // namespace parity
