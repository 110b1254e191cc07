#include "cpu_reference/fluid/step.h"

#include "cpu_reference/fluid/advect.h"
#include "cpu_reference/fluid/forces.h"
#include "cpu_reference/fluid/momentum.h"
#include "cpu_reference/fluid/project.h"
#include "cpu_reference/fluid/tiles.h"

namespace parity::cpu {
namespace {

/// a x + b y + c z of every face.
FaceFields combine(double a, const FaceFields& x, double b, const FaceFields& y, double c,
                   const FaceFields& z) {
  FaceFields sum = x;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < x[axis].values.size(); ++i)
      sum[axis].values[i] = a * x[axis].values[i] + b * y[axis].values[i] + c * z[axis].values[i];
  return sum;
}

/// The part `share` of an Euler step from `stage`, the rest `begin`.
FluidState runge_kutta_stage(const FluidProblem& problem, const FluidState& begin,
                             const FluidState& stage, double share, double seconds) {
  FluidState result = stage;
  result.velocity = combine(1 - share, begin.velocity, share, stage.velocity, share * seconds,
                            momentum_rate(problem, stage.velocity));
  result.time = begin.time + seconds;
  return project(problem, result, share * seconds);
}

FluidState runge_kutta_step(const FluidProblem& problem, const FluidState& state, double seconds) {
  const FluidState first = runge_kutta_stage(problem, state, state, 1, seconds);
  const FluidState second = runge_kutta_stage(problem, state, first, 1.0 / 4, seconds);
  return runge_kutta_stage(problem, state, second, 2.0 / 3, seconds);
}

FluidState split_step(const FluidProblem& problem, const FluidState& before, double seconds) {
  const FluidParameters& p = problem.parameters;
  const FluidState state = p.sparse ? choose_active(problem, before) : before;
  const ActivePoints active(problem.domain, state.active);
  FluidState result = state;
  result.smoke = advect(problem, state, state.smoke, -1, seconds);
  result.temperature = advect(problem, state, state.temperature, -1, seconds);
  for (int axis = 0; axis < 3; ++axis)
    result.velocity[std::size_t(axis)] =
        advect(problem, state, state.velocity[std::size_t(axis)], axis, seconds);
  if (p.viscosity > 0)
    result.velocity = p.implicit_viscosity
                          ? diffuse_implicit(problem.domain, result.velocity, p.viscosity, seconds)
                          : diffuse_explicit(problem.domain, result.velocity, p.viscosity, seconds);
  for (int axis = 0; axis < 3; ++axis) active.clear_rest(axis, result.velocity[std::size_t(axis)]);
  // After viscosity: what a force pushes against a wall is not yet flow that could rub on it.
  result = push(problem, hold_sources(problem, result, seconds), seconds);
  result.time = state.time + seconds;
  return project(problem, result, seconds);
}

}  // namespace

FluidState step(const FluidProblem& problem, const FluidState& state, double seconds) {
  FluidState result = is_split(problem.parameters.method)
                          ? split_step(problem, state, seconds)
                          : runge_kutta_step(problem, state, seconds);
  result.time = state.time + seconds;
  result.steps = state.steps + 1;
  return result;
}

FluidState run(const FluidProblem& problem, FluidState state, double seconds, int count) {
  for (int k = 0; k < count; ++k) state = step(problem, state, seconds);
  return state;
}

}  // namespace parity::cpu
