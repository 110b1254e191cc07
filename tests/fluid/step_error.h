#pragma once

#include <algorithm>

#include "gpu/fluid/adapt.h"
#include "tests/fluid/fluid_fields.h"

/// Runs of grid fluids whose steps are chosen by their error.
namespace parity::step_error_test {

struct Outcome {
  FluidState state;
  StepControl control;
};

/// By error if the problem has a tolerance, else by CFL or with its fixed step.
inline Outcome on_device(gpu::Context& context, const FluidProblem& problem, double time,
                         double first = 0) {
  gpu::FluidSimulation simulation(context, problem);
  if (problem.parameters.step_error == 0) {
    simulation.run_until(time);
    return {.state = simulation.read(), .control = {}};
  }
  gpu::AdaptiveFluid fluid(context, simulation, problem.parameters);
  Outcome outcome;
  outcome.control.allowed = first;
  while (simulation.clock().time < float(time)) fluid.step(outcome.control, time);
  outcome.state = simulation.read();
  return outcome;
}

/// Taylor-Green on 16^2 cells by MacCormack, splitting error and all; the flow crosses a cell in
/// 0.2 s.
inline FluidProblem decaying_vortex(double tolerance) {
  FluidProblem problem = taylor_green(16, 0.05, 2);
  problem.parameters.method = FluidMethod::maccormack;
  problem.parameters.courant = 0.8;
  problem.parameters.max_step = 1;
  problem.parameters.divergence = 1e-5;
  problem.parameters.max_iterations = 60;
  problem.parameters.step_error = tolerance;
  return problem;
}

/// Largest difference of the velocities, m/s.
inline double flows_apart(const FaceFields& a, const FaceFields& b) {
  double largest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    largest = std::max(largest, largest_apart(a[axis], b[axis]));
  return largest;
}

/// To the closed form, a second later.
inline double vortex_error(const FluidState& state) {
  return flows_apart(state.velocity, taylor_green_velocity(decaying_vortex(0).domain, 0.05, 1));
}

}  // namespace parity::step_error_test
