#include "cpu_reference/sph/forces.h"

#include <gtest/gtest.h>

#include "gpu/sph/forces.h"
#include "tests/compare.h"
#include "tests/sph/problems.h"

namespace parity {
namespace {

std::vector<dvec3> reference(const SphProblem& problem) {
  const SphNeighbourLists lists = cpu::sph_neighbours(problem);
  return cpu::sph_accelerations(problem, lists, cpu::sph_densities(problem, lists));
}

const Registration registration = register_stage<SphProblem, std::vector<dvec3>>({
    .name = "sph/forces",
    .title = "Pressure, viscosity, surface tension and walls between particles",
    .source = "notes 10.4; Monaghan 1992, 2005; Becker & Teschner 2007; Akinci et al. 2012",
    .rows = {168},
    .axes = sph_test::tank_axes(),
    .problem = sph_test::tank_of,
    .cpu = {{.solve = reference}},
    .gpu = {{.name = "lists",
             .solve =
                 [](gpu::Context& context, const SphProblem& p) {
                   const std::vector<vec3> a = gpu::sph_accelerations(context, p);
                   return std::vector<dvec3>(a.begin(), a.end());
                 }}},
    .distance = [](const std::vector<dvec3>& got,
                   const std::vector<dvec3>& want) { return largest_difference(got, want); },
    .tolerance = sph_test::acceleration_bound,
    .why = "the densities' bound through the slope of the equation of state, and 60 u of the "
           "largest that each of the n terms can be",
});

}  // namespace
}  // namespace parity
