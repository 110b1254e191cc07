#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cpu_reference/fluid/step.h"
#include "gpu/fluid/step.h"
#include "tests/fluid/fluid_fields.h"
#include "tests/gpu_context.h"

/// Sparse fluids: only tiles near what moves are computed.
namespace parity {
namespace {

/// A plume that has risen for a while in three dimensions.
FluidProblem young_plume(int cells) {
  FluidProblem problem = smoke_plume(cells, 3);
  problem.parameters.sparse = true;
  problem.parameters.fixed_step = 0.04;
  return problem;
}

FluidState after_steps(const FluidProblem& problem, std::uint32_t steps, bool visit_all) {
  gpu::FluidSimulation simulation(test_context(), problem);
  if (visit_all) simulation.visit_all_tiles();
  simulation.run_until(1e9, 4, steps);
  return simulation.read();
}

double active_part(const FluidState& state) {
  return double(std::ranges::count(state.active, 1)) / double(state.active.size());
}

TEST(SparseFluid, HasTheBitsOfARunThatVisitsTheWholeBox) {
  FluidProblem smoke = young_plume(16), liquid = dam_break(12, 1, 2);
  liquid.parameters.sparse = true;
  liquid.parameters.fixed_step = 0.01;
  for (const FluidProblem& problem : {smoke, liquid}) {
    const FluidState sparse = after_steps(problem, 8, false);
    EXPECT_LT(active_part(sparse), 0.85);
    EXPECT_EQ(numbers_of(sparse), numbers_of(after_steps(problem, 8, true)));
  }
}

/// 40 x 40 cells are 5 x 10 tiles.
TEST(ActiveCells, AreThoseOfTilesWithinTheMarginOfABusyCell) {
  FluidProblem problem = hydrostatic_box(40, 2);
  problem.domain.cells.x = 40;
  problem.initial = resting_state(problem.domain);
  problem.parameters.courant = 2.5;  // a margin of 3
  const auto active = [&](int x, int y) {
    return active_cells(problem, problem.initial)[std::size_t(40 * y + x)] == 1;
  };
  EXPECT_FALSE(active(13, 20));
  problem.initial.smoke(13, 20, 0) = 1;
  EXPECT_TRUE(active(13, 20));
  EXPECT_TRUE(active(8, 23));
  EXPECT_TRUE(active(23, 16));   // tile 2 begins 3 cells on
  EXPECT_FALSE(active(7, 20));   // tile 0 ended 6 cells before
  EXPECT_TRUE(active(13, 17));   // the row of tiles below ends one cell before
  EXPECT_FALSE(active(13, 24));  // the row above begins 4 cells on
  problem.initial.smoke(13, 20, 0) = 0;
  problem.initial.velocity[0](40, 0, 0) = 1;  // the last face of a row
  EXPECT_TRUE(active(39, 0));
  EXPECT_FALSE(active(0, 0));
}

/// A puff that drifts: tiles behind it are left, and are empty then.
TEST(SparseFluid, LeavesNothingBehindAndAgreesWithTheReference) {
  FluidProblem problem = smoke_plume(48, 2);
  problem.domain.cells = {48, 24, 1};
  problem.initial = resting_state(problem.domain);
  problem.solids.clear();
  problem.sources.clear();
  problem.parameters.sparse = true;
  problem.parameters.busy_speed = 0.7;
  problem.parameters.divergence = 2e-5;
  problem.parameters.max_iterations = 60;
  for (int y = 9; y < 15; ++y)
    for (int x = 4; x < 10; ++x) {
      problem.initial.smoke(x, y, 0) = 1;
      problem.initial.velocity[0](x, y, 0) = 2;
    }
  const double step = 1.0 / 48;
  const int steps = 20;
  FluidProblem fixed = problem;
  fixed.parameters.fixed_step = step;
  const FluidState first = after_steps(fixed, 1, false), got = after_steps(fixed, steps, false);
  const FluidState want = cpu::run(problem, problem.initial, step, steps);
  ASSERT_EQ(got.active, want.active);
  EXPECT_NE(first.active, got.active);
  EXPECT_LT(states_apart(got, want),
            steps * 3 * flow_tolerance({.fluid = problem, .seconds = step}, 3 * 60 * 2.6));
  for (std::size_t i = 0; i < got.active.size(); ++i)
    if (got.active[i] == 0) {
      EXPECT_EQ(got.smoke.values[i], 0);
      EXPECT_EQ(got.pressure.values[i], 0);
    }
}

TEST(SparseFluid, LiquidsAreWhatTheyAreInTheWholeBox) {
  FluidProblem problem = dam_break(12, 1, 2);
  problem.parameters.fixed_step = 0.01;
  problem.parameters.divergence = 1e-4;
  problem.parameters.max_iterations = 60;
  const FluidState whole = after_steps(problem, 6, false);
  problem.parameters.sparse = true;
  const FluidState sparse = after_steps(problem, 6, false);
  // Both solve the same equations to the divergence asked for; the order of sums differs.
  const double bound =
      6 * (2 * 1e-4 * 5 + 300 * 2 * 0x1p-24 + problem.domain.cells.x * 4 * 0x1p-24);
  for (std::size_t i = 0; i < whole.particles.count(); ++i) {
    const LiquidParticles &got = sparse.particles, &want = whole.particles;
    EXPECT_LT(double(glm::distance(got.positions[i], want.positions[i])),
              bound * problem.domain.spacing);
    EXPECT_LT(double(glm::distance(got.velocities[i], want.velocities[i])), bound);
  }
}

TEST(SparseFluid, RefusesWhatItCannotDo) {
  const auto refused = [](const auto& change) {
    FluidProblem problem = smoke_plume(8, 2);
    problem.parameters.sparse = true;
    EXPECT_NO_THROW(check_fluid_problem(problem));
    change(problem);
    EXPECT_THROW(check_fluid_problem(problem), std::invalid_argument);
  };
  refused([](FluidProblem& p) { p.parameters.method = FluidMethod::central; });
  refused([](FluidProblem& p) { p.parameters.implicit_viscosity = true; });
  refused([](FluidProblem& p) { p.parameters.courant = 4; });
  refused([](FluidProblem& p) { p.parameters.busy_speed = std::nan(""); });
  refused([](FluidProblem& p) { p.solids[0].velocity = {1, 0, 0}; });
  refused([](FluidProblem& p) {
    p.domain.cells = {2048, 1024, 1};
    p.initial = resting_state(p.domain);
  });
  refused([](FluidProblem& p) {
    p.domain.walls[0].kind = p.domain.walls[1].kind = WallKind::periodic;
  });
}

}  // namespace
}  // namespace parity
