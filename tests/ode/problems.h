#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <tuple>

#include "cpu_reference/ode/integrate.h"
#include "geometry/random.h"
#include "sim/ode.h"
#include "tests/setting.h"

/// Problems of the ode chapter, and the stability functions of its methods.
namespace parity {

inline auto fields_of(const OdeInstance*) {
  return std::tuple{&OdeInstance::initial, &OdeInstance::parameters};
}
inline auto fields_of(const OdeProblem*) {
  return std::tuple{&OdeProblem::method, &OdeProblem::system, &OdeProblem::instances,
                    &OdeProblem::step,   &OdeProblem::steps,  &OdeProblem::tolerance};
}
inline auto fields_of(const OdeResult*) {
  return std::tuple{&OdeResult::states, &OdeResult::evaluations};
}

namespace ode_test {

inline OdeInstance random_instance(OdeSystem system, Random& random) {
  OdeInstance instance;
  instance.initial = {random.uniform(-1, 1), random.uniform(-1, 1)};
  switch (system) {
    case OdeSystem::linear:
      instance.parameters = {random.uniform(-1, 0), random.uniform(-3, 3)};
      break;
    case OdeSystem::driven:
      instance.parameters = {random.uniform(-3, -0.5f), random.uniform(-1, 0)};
      break;
    default:
      instance.parameters = {random.uniform(0.3f, 1.5f), 0};
  }
  return instance;
}

inline OdeProblem problem_of(OdeMethod method, const Setting& setting) {
  OdeProblem problem{.method = method,
                     .system = OdeSystem(setting.count("system")),
                     .step = setting.at("step"),
                     .steps = std::uint32_t(setting.count("steps"))};
  Random random{setting.seed};
  for (int i = 0; i < setting.count("count"); ++i)
    problem.instances.push_back(random_instance(problem.system, random));
  return problem;
}

inline double distance(const OdeResult& got, const OdeResult& want) {
  double worst = 0;
  for (std::size_t i = 0; i < want.states.size(); ++i) {
    const double apart = glm::length(got.states[i] - want.states[i]);
    worst = std::isfinite(apart) ? std::max(worst, apart) : INFINITY;
  }
  return worst;
}

/// By how much a problem enlarges a small error of its start, measured.
inline double condition(OdeProblem problem, const OdeResult& plain) {
  double worst = 1;
  for (const dvec2 way : {dvec2(1, 0), dvec2(0, 1)}) {
    OdeProblem moved = problem;
    for (OdeInstance& instance : moved.instances) instance.initial += vec2(way * 0x1p-12);
    worst = std::max(worst, distance(cpu::integrate(moved), plain) / 0x1p-12);
  }
  return worst;
}

/// An error of 4 u of the state in each step, from stopping Newton's method or rounding where f is
/// evaluated, and 30 u of the change; each is enlarged as an error of the start would be, and half
/// as much again to allow for the worst time to make it. Adaptive: the tolerance a step, on both
/// sides.
inline double rounding_bound(const OdeProblem& problem) {
  constexpr double u = 0x1p-24;
  const OdeResult plain = cpu::integrate(problem);
  double size = 1, slope = 1, evaluations = 0;
  for (std::size_t i = 0; i < plain.states.size(); ++i) {
    const OdeInstance& instance = problem.instances[i];
    size = std::max({size, glm::length(plain.states[i]), double(glm::length(instance.initial))});
    slope = std::max(slope, 1 + std::abs(double(instance.parameters.x)) +
                                std::abs(double(instance.parameters.y)) +
                                std::pow(double(instance.parameters.x), 2));
    evaluations = std::max(evaluations, double(plain.evaluations[i]));
  }
  const double time = problem.step * problem.steps;
  double error = 4 * u * size * (problem.steps + 1) + 30 * u * time * slope * size;
  if (problem.method == OdeMethod::dormand_prince)
    error += 2 * (evaluations / 7 + 1) * problem.tolerance * (1 + size);
  return 1.5 * condition(problem, plain) * error;
}

/// R(z) of a method: what a step of h makes of x' = lambda x, z = h lambda.
inline double amplification(OdeMethod method, double x, double y) {
  const std::complex<double> z(x, y);
  switch (method) {
    case OdeMethod::implicit_euler:
      return std::abs(1.0 / (1.0 - z));
    case OdeMethod::trapezoid:
      return std::abs((1.0 + z / 2.0) / (1.0 - z / 2.0));
    case OdeMethod::midpoint:
      return std::abs(1.0 + z + z * z / 2.0);
    case OdeMethod::rk4:
      return std::abs(1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0))));
    default:
      return std::abs(1.0 + z);
  }
}

/// The largest y below 4 at which |R(x + i y)| crosses 1, from the formula; NaN where it does not.
inline double stability_border(OdeMethod method, double x) {
  constexpr int steps = 4000;
  for (int k = steps; k > 0; --k) {
    const double y = 4.0 * k / steps;
    if ((amplification(method, x, y) <= 1) != (amplification(method, x, y - 4.0 / steps) <= 1))
      return y - 2.0 / steps;
  }
  return NAN;
}

}  // namespace ode_test
}  // namespace parity
