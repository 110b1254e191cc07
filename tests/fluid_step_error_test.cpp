#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "cpu_reference/fluid/adapt.h"
#include "cpu_reference/fluid/step.h"
#include "tests/fluid/step_error.h"
#include "tests/gpu_context.h"

/// Time steps of fluids on grids by their error.
namespace parity {
namespace {

using namespace step_error_test;

TEST(StepControl, TheErrorIsThatOfTheHalvesAndRelative) {
  // C h^(p + 1) whole, twice C (h / 2)^(p + 1) in halves: their error is 1 / (2^p - 1) of what
  // lies between.
  for (const int order : {1, 2, 3}) {
    const double whole = 0.8, halves = 2 * whole * std::pow(0.5, order + 1);
    EXPECT_NEAR(step_error(whole - halves, 4, order), halves / 4, 1e-15);
  }
  EXPECT_EQ(step_error(0, 0, 1), 0);
  EXPECT_EQ(step_error(1, 0, 1), HUGE_VAL);
}

TEST(StepControl, NextStepsFollowTheOrderBetweenClamps) {
  const auto next = [](double error, int order) {
    StepControl control;
    settle_step(control, error, 1e-3, 1, 100, order);
    return control.allowed;
  };
  EXPECT_DOUBLE_EQ(next(1e-3, 1), 0.9);
  EXPECT_DOUBLE_EQ(next(4e-3, 1), 0.45);
  EXPECT_DOUBLE_EQ(next(16e-3, 3), 0.45);
  EXPECT_DOUBLE_EQ(next(0.25e-3, 1), 1.8);
  EXPECT_DOUBLE_EQ(next(0, 1), 2);
  EXPECT_DOUBLE_EQ(next(1, 1), 0.2);
  EXPECT_DOUBLE_EQ(next(HUGE_VAL, 1), 0.2);
  EXPECT_DOUBLE_EQ(next(std::nan(""), 1), 0.2);
}

TEST(StepControl, RefusesWhatIsAboveTheToleranceUntilTheShortestStep) {
  StepControl control;
  EXPECT_TRUE(settle_step(control, 1e-3, 1e-3, 0.1, 1, 1));
  EXPECT_FALSE(settle_step(control, 1.001e-3, 1e-3, 0.1, 1, 1));
  EXPECT_FALSE(settle_step(control, std::nan(""), 1e-3, 0.1, 1, 1));
  EXPECT_EQ(control.refused, 2u);
  int tries = 0;
  while (!settle_step(control, 1, 1e-3, trial_step(control, 1, 1e9), 1, 1)) ++tries;
  EXPECT_LE(tries, 5);  // 0.2^5 < 1 / 1024
  EXPECT_DOUBLE_EQ(control.allowed, 1.0 / 1024);
}

TEST(StepControl, TrialsEndExactlyAndStayStable) {
  StepControl control;
  EXPECT_EQ(trial_step(control, 0.5, 10), 0.5);
  control.allowed = 0.3;
  EXPECT_EQ(trial_step(control, 0.5, 10), 0.3);
  EXPECT_EQ(trial_step(control, 0.2, 10), 0.2);
  EXPECT_EQ(trial_step(control, 0.5, 0.4), 0.2);
  EXPECT_EQ(trial_step(control, 0.5, 0.25), 0.25);
  // A step that the end cut short does not make the next one short.
  EXPECT_TRUE(settle_step(control, 1e-9, 1e-3, 0.01, 0.5, 1));
  EXPECT_EQ(control.allowed, 0.3);
  EXPECT_FALSE(settle_step(control, 1, 1e-3, 0.1, 0.5, 1));
  EXPECT_LT(control.allowed, 0.1);
}

Outcome on_host(const FluidProblem& problem, double time, double first) {
  Outcome outcome{.state = problem.initial, .control = {.allowed = first}};
  while (outcome.state.time < time)
    outcome.state = cpu::adaptive_step(problem, outcome.state, outcome.control, time);
  return outcome;
}

/// Splitting errs by C h^2 a step, so h goes with the square root of the tolerance, and so does the
/// error at the end. The error in space, 1e-4 with the other sign, and the last two steps, which
/// are shortened, bend the exponent by a tenth.
TEST(FluidStepError, FallsWithTheRootOfTheTolerance) {
  const Outcome coarse = on_device(test_context(), decaying_vortex(1e-3), 1);
  const Outcome fine = on_device(test_context(), decaying_vortex(4e-5), 1);
  const double exponent =
      std::log(vortex_error(coarse.state) / vortex_error(fine.state)) / std::log(25);
  EXPECT_GT(exponent, 0.4);
  EXPECT_LT(exponent, 0.65);
  const double growth = std::log(double(fine.state.steps) / coarse.state.steps) / std::log(25);
  EXPECT_NEAR(growth, 0.5, 0.1);
  // As many steps by CFL err more: twice as much, since two halves stand in each.
  FluidProblem even = decaying_vortex(0);
  even.parameters.fixed_step = 1.0 / fine.state.steps;
  EXPECT_GT(vortex_error(on_device(test_context(), even, 1).state), 1.5 * vortex_error(fine.state));
}

/// Runge-Kutta 3 errs so little at its stable step that no tolerance of use shortens it.
TEST(FluidStepError, LeavesTheStableStepWhereItIsGoodEnough) {
  FluidProblem problem = decaying_vortex(1e-4);
  problem.parameters.method = FluidMethod::central;
  const Outcome outcome = on_device(test_context(), problem, 1);
  problem.parameters.step_error = 0;
  EXPECT_EQ(outcome.control.refused, 0u);
  EXPECT_EQ(outcome.state.steps, on_device(test_context(), problem, 1).state.steps);
}

/// From the same first step. Steps follow the square root of an estimate that both know to the
/// divergence that projections leave.
TEST(FluidStepError, DeviceAndReferenceTakeTheSameSteps) {
  for (const double tolerance : {3e-4, 1e-4}) {
    const FluidProblem problem = decaying_vortex(tolerance);
    const Outcome got = on_device(test_context(), problem, 1, 0.07),
                  want = on_host(problem, 1, 0.07);
    EXPECT_GT(want.control.refused, 0u);
    EXPECT_EQ(got.control.refused, want.control.refused);
    EXPECT_EQ(got.state.steps, want.state.steps);
    // Far closer to each other than either is to the truth.
    EXPECT_LT(states_apart(got.state, want.state), 0.02 * vortex_error(want.state));
  }
}

/// Smoke around a ball that moves.
FluidProblem stirred_plume() {
  FluidProblem problem = smoke_plume(16, 2);
  problem.solids.at(0).velocity = {0.4, -0.1, 0};
  problem.parameters.step_error = 1e-3;
  return problem;
}

std::vector<double> all_numbers(const FluidState& state) {
  std::vector<double> numbers = numbers_of(state);
  numbers.insert(numbers.end(), state.pressure.values.begin(), state.pressure.values.end());
  numbers.push_back(state.time);
  numbers.push_back(state.steps);
  return numbers;
}

TEST(FluidStepError, ARefusedStepLeavesNoTraceOnTheDevice) {
  const FluidProblem problem = stirred_plume();
  gpu::FluidSimulation simulation(test_context(), problem), fresh(test_context(), problem);
  gpu::AdaptiveFluid fluid(test_context(), simulation, problem.parameters);
  simulation.run_until(0.3);
  const FluidState before = simulation.read();
  EXPECT_GT(fluid.try_step(0.1f), 0);
  EXPECT_NE(all_numbers(simulation.read()), all_numbers(before));
  fluid.undo();
  EXPECT_EQ(all_numbers(simulation.read()), all_numbers(before));
  // Nor in what no one reads.
  fresh.write(before);
  gpu::AdaptiveFluid other(test_context(), fresh, problem.parameters);
  EXPECT_EQ(fluid.try_step(0.01f), other.try_step(0.01f));
  EXPECT_EQ(all_numbers(simulation.read()), all_numbers(fresh.read()));
}

/// A step that was refused at first is the one that would have been taken at once. From time 0, so
/// that the clock shows its length to the last bit.
TEST(FluidStepError, RepeatsFromTheSameState) {
  const FluidProblem problem = stirred_plume();
  gpu::FluidSimulation simulation(test_context(), problem);
  gpu::AdaptiveFluid fluid(test_context(), simulation, problem.parameters);
  simulation.run_until(0.3);
  FluidState begin = simulation.read(), ends[2], hosts[2];
  begin.time = 0;
  StepControl of_device, of_host;
  for (int k = 0; k < 2; ++k) {
    simulation.write(begin);
    EXPECT_EQ(fluid.step(of_device, 100), 1u);
    ends[k] = simulation.read();
    hosts[k] = cpu::adaptive_step(problem, begin, of_host, 100);
    EXPECT_EQ(of_device.refused > 0, k == 0);
    EXPECT_EQ(of_host.refused > 0, k == 0);
    of_device = {.allowed = ends[k].time};
    of_host = {.allowed = hosts[k].time};
  }
  EXPECT_EQ(all_numbers(ends[0]), all_numbers(ends[1]));
  EXPECT_EQ(all_numbers(hosts[0]), all_numbers(hosts[1]));
}

TEST(FluidStepError, RefusesWhatHasNoErrorOfAStep) {
  const auto refused = [](const auto& change) {
    FluidProblem problem = smoke_plume(8, 2);
    problem.parameters.step_error = 0.01;
    EXPECT_NO_THROW(check_fluid_problem(problem));
    change(problem.parameters);
    EXPECT_THROW(check_fluid_problem(problem), std::invalid_argument);
  };
  refused([](FluidParameters& p) { p.step_error = 0.2; });
  refused([](FluidParameters& p) { p.step_error = -0.01; });
  refused([](FluidParameters& p) { p.step_error = std::nan(""); });
  refused([](FluidParameters& p) { p.fixed_step = 0.01; });
  refused([](FluidParameters& p) { p.sparse = true; });
  refused([](FluidParameters& p) { p.method = FluidMethod::flip; });
}

}  // namespace
}  // namespace parity
