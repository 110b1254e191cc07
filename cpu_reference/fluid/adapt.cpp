#include "cpu_reference/fluid/adapt.h"

#include <algorithm>
#include <cmath>

#include "cpu_reference/fluid/step.h"

namespace parity::cpu {

double stable_step(const FluidProblem& problem, const FluidState& state) {
  const FluidParameters& p = problem.parameters;
  const double h = problem.domain.spacing, axes = problem.domain.is_flat() ? 2 : 3;
  const double speed = std::max(axes * measure(problem, state).max_speed, 1e-9);
  const double step = std::min(p.max_step, p.courant * h / speed);
  return p.viscosity > 0 ? std::min(step, 0.9 * h * h / (2 * axes * p.viscosity)) : step;
}

DoubledStep doubled_step(const FluidProblem& problem, const FluidState& state, double seconds) {
  const FluidState whole = step(problem, state, seconds);
  DoubledStep result{.state = run(problem, state, 0.5 * seconds, 2)};
  result.state.time = state.time + seconds;
  result.state.steps = state.steps + 1;
  double apart = 0, speed = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < whole.velocity[axis].values.size(); ++i) {
      const double u = result.state.velocity[axis].values[i];
      apart = std::fmax(apart, std::abs(u - whole.velocity[axis].values[i]));
      speed = std::fmax(speed, std::abs(u));
    }
  result.error = step_error(apart, speed, order_of(problem.parameters.method));
  return result;
}

FluidState adaptive_step(const FluidProblem& problem, const FluidState& state, StepControl& control,
                         double until) {
  const double stable = stable_step(problem, state), left = until - state.time;
  const int order = order_of(problem.parameters.method);
  for (;;) {
    const double seconds = trial_step(control, stable, left);
    DoubledStep tried = doubled_step(problem, state, seconds);
    if (!settle_step(control, tried.error, problem.parameters.step_error, seconds, stable, order))
      continue;
    if (seconds == left) tried.state.time = until;
    return tried.state;
  }
}

}  // namespace parity::cpu
