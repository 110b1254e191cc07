#include "sim/ode.h"

#include <cmath>
#include <complex>
#include <stdexcept>
#include <string>

namespace parity {

const char* name_of(OdeMethod method) {
  switch (method) {
    case OdeMethod::explicit_euler:
      return "explicit_euler";
    case OdeMethod::implicit_euler:
      return "implicit_euler";
    case OdeMethod::symplectic_euler:
      return "symplectic_euler";
    case OdeMethod::trapezoid:
      return "trapezoid";
    case OdeMethod::midpoint:
      return "midpoint";
    case OdeMethod::rk4:
      return "rk4";
    case OdeMethod::dormand_prince:
      return "dormand_prince";
  }
  return "unknown";
}

void check_ode_problem(const OdeProblem& problem) {
  if (!(problem.step > 0 && problem.step < 1e30))
    throw std::invalid_argument("ode: step is " + std::to_string(problem.step) +
                                ", must be positive and finite");
  if (!(problem.tolerance >= 1e-14 && problem.tolerance <= 1))
    throw std::invalid_argument("ode: tolerance is " + std::to_string(problem.tolerance) +
                                ", must be in 1e-14 to 1");
  for (std::size_t i = 0; i < problem.instances.size(); ++i) {
    const OdeInstance& instance = problem.instances[i];
    const double sum = double(instance.initial.x) + instance.initial.y + instance.parameters.x +
                       instance.parameters.y;
    if (!std::isfinite(sum))
      throw std::invalid_argument("ode: instance " + std::to_string(i) + " is not finite, must be");
  }
}

std::optional<dvec2> ode_exact(OdeSystem system, const OdeInstance& instance, double t) {
  const double a = instance.parameters.x;
  const double b = instance.parameters.y;
  const dvec2 start{instance.initial};
  if (system == OdeSystem::linear) {
    const auto z = std::complex(start.x, start.y) * std::exp(std::complex(a, b) * t);
    return dvec2(z.real(), z.imag());
  }
  if (system == OdeSystem::oscillator && a != 0)
    return dvec2(start.x * std::cos(a * t) + start.y / a * std::sin(a * t),
                 start.y * std::cos(a * t) - start.x * a * std::sin(a * t));
  if (system == OdeSystem::driven)
    return dvec2(std::cos(t) + (start.x - 1) * std::exp(a * t), start.y * std::exp(b * t));
  return std::nullopt;
}

double ode_energy(OdeSystem system, const OdeInstance& instance, const dvec2& state) {
  const double a = instance.parameters.x;
  const double potential =
      system == OdeSystem::pendulum ? 1 - std::cos(state.x) : state.x * state.x / 2;
  return state.y * state.y / 2 + a * a * potential;
}

}  // namespace parity
