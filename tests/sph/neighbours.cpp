#include "cpu_reference/sph/neighbours.h"

#include "gpu/sph/neighbours.h"
#include "tests/compare.h"
#include "tests/sph/problems.h"

namespace parity {
namespace {

const Registration registration = register_stage<SphProblem, SphNeighbourLists>({
    .name = "sph/neighbours",
    .title = "Particles and wall particles within the support, by sorted cells",
    .source = "notes 10.4; Green 2010",
    .rows = {168},
    .axes = sph_test::tank_axes(),
    .problem = sph_test::tank_of,
    .cpu = {{.solve = [](const SphProblem& p) { return cpu::sph_neighbours(p); }}},
    .gpu = {{.name = "cells",
             .solve = [](gpu::Context& context,
                         const SphProblem& p) { return gpu::sph_neighbours(context, p); }}},
    .distance = [](const SphNeighbourLists& got,
                   const SphNeighbourLists& want) { return count_differences(got, want); },
    .tolerance = 0.0,
    .why = "both decide r^2 < H^2 in float by the same operations, so the lists are equal",
});

}  // namespace
}  // namespace parity
