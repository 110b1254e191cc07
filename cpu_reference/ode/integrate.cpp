#include "cpu_reference/ode/integrate.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <stdexcept>
#include <vector>

namespace parity::cpu {
namespace {

/// Coefficients of an explicit Runge-Kutta method; `error` are those of the difference from an
/// embedded method, if it has one.
struct Tableau {
  std::vector<double> times;
  std::vector<std::vector<double>> stages;
  std::vector<double> weights;
  std::vector<double> error = {};
};

const Tableau& tableau_of(OdeMethod method) {
  static const Tableau euler{{0}, {{}}, {1}};
  static const Tableau midpoint{{0, 0.5}, {{}, {0.5}}, {0, 1}};
  static const Tableau rk4{
      {0, 0.5, 0.5, 1}, {{}, {0.5}, {0, 0.5}, {0, 0, 1}}, {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6}};
  static const Tableau dormand_prince{
      {0, 1.0 / 5, 3.0 / 10, 4.0 / 5, 8.0 / 9, 1, 1},
      {{},
       {1.0 / 5},
       {3.0 / 40, 9.0 / 40},
       {44.0 / 45, -56.0 / 15, 32.0 / 9},
       {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
       {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
       {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}},
      {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84, 0},
      {35.0 / 384 - 5179.0 / 57600, 0, 500.0 / 1113 - 7571.0 / 16695, 125.0 / 192 - 393.0 / 640,
       -2187.0 / 6784 + 92097.0 / 339200, 11.0 / 84 - 187.0 / 2100, -1.0 / 40}};
  switch (method) {
    case OdeMethod::midpoint:
      return midpoint;
    case OdeMethod::rk4:
      return rk4;
    case OdeMethod::dormand_prince:
      return dormand_prince;
    default:
      return euler;
  }
}

struct Step {
  dvec2 state;
  dvec2 error{0};
  std::uint32_t evaluations = 0;
};

Step explicit_step(const Tableau& table, const OdeSlope& f, const dvec2& state, double t,
                   double h) {
  std::vector<dvec2> slopes;
  for (std::size_t s = 0; s < table.stages.size(); ++s) {
    dvec2 at = state;
    for (std::size_t k = 0; k < table.stages[s].size(); ++k)
      at += h * table.stages[s][k] * slopes[k];
    slopes.push_back(f(at, t + table.times[s] * h));
  }
  Step step{state, dvec2(0), std::uint32_t(slopes.size())};
  for (std::size_t s = 0; s < slopes.size(); ++s) {
    step.state += h * table.weights[s] * slopes[s];
    if (!table.error.empty()) step.error += h * table.error[s] * slopes[s];
  }
  return step;
}

/// Solves next = known + weight f(next) by Newton's method with differences for the Jacobian.
Step solve_implicit(const OdeSlope& f, const dvec2& guess, const dvec2& known, double weight,
                    double t) {
  Step step{guess};
  for (int round = 0; round < 50; ++round) {
    const dvec2 slope = f(step.state, t);
    step.evaluations += 1;
    const dvec2 off = step.state - known - weight * slope;
    dmat2 jacobian(1);
    for (int k = 0; k < 2; ++k) {
      dvec2 moved = step.state;
      const double by = 1e-7 * std::max(1.0, std::abs(moved[k]));
      moved[k] += by;
      jacobian[k] -= weight * (f(moved, t) - slope) / by;
    }
    const dvec2 change = glm::inverse(jacobian) * off;
    step.state -= change;
    if (!(glm::length(change) > 1e-14 * std::max(1e-300, glm::length(step.state)))) break;
  }
  return step;
}

Step fixed_step(OdeMethod method, const OdeSlope& f, const dvec2& state, double t, double h) {
  switch (method) {
    case OdeMethod::implicit_euler:
      return solve_implicit(f, state, state, h, t + h);
    case OdeMethod::trapezoid: {
      const dvec2 known = state + h / 2 * f(state, t);
      Step step = solve_implicit(f, state, known, h / 2, t + h);
      step.evaluations += 1;
      return step;
    }
    case OdeMethod::symplectic_euler: {
      const double velocity = state.y + h * f(state, t).y;
      return {dvec2(state.x + h * f(dvec2(state.x, velocity), t).x, velocity), dvec2(0), 2};
    }
    default:
      return explicit_step(tableau_of(method), f, state, t, h);
  }
}

Step run_adaptive(const OdeProblem& problem, const OdeInstance& instance) {
  const OdeSlope f = ode_slope(problem.system, instance);
  const double end = problem.step * problem.steps;
  double t = 0, h = problem.step, old = 1;
  Step now{dvec2(instance.initial)};
  for (int round = 0; t < end; ++round) {
    if (round >= 1 << 20)
      throw std::invalid_argument("cpu::integrate: not at the end after 2^20 steps");
    const bool last = t + h >= end;
    if (last) h = end - t;
    const Step trial = explicit_step(tableau_of(problem.method), f, now.state, t, h);
    now.evaluations += trial.evaluations;
    const dvec2 scale =
        problem.tolerance * (1.0 + glm::max(glm::abs(now.state), glm::abs(trial.state)));
    const double error = std::max(1e-8, glm::length(trial.error / scale) / std::sqrt(2.0));
    if (!(error <= 1)) {
      h *= std::isfinite(error) ? std::clamp(0.9 * std::pow(error, -0.25), 0.2, 1.0) : 0.2;
      continue;
    }
    now.state = trial.state;
    t = last ? end : t + h;
    h *= std::clamp(0.9 * std::pow(error, -0.125) * std::pow(old, 0.0625), 0.2, 5.0);
    old = std::max(error, 1e-4);
  }
  return now;
}

Step run_fixed(const OdeProblem& problem, const OdeInstance& instance) {
  const OdeSlope f = ode_slope(problem.system, instance);
  Step now{dvec2(instance.initial)};
  for (std::uint32_t k = 0; k < problem.steps; ++k) {
    const Step next = fixed_step(problem.method, f, now.state, k * problem.step, problem.step);
    now.state = next.state;
    now.evaluations += next.evaluations;
  }
  return now;
}

}  // namespace

OdeSlope ode_slope(OdeSystem system, const OdeInstance& instance) {
  const double a = instance.parameters.x;
  const double b = instance.parameters.y;
  switch (system) {
    case OdeSystem::linear:
      return [=](const dvec2& s, double) {
        const auto z = std::complex(a, b) * std::complex(s.x, s.y);
        return dvec2(z.real(), z.imag());
      };
    case OdeSystem::oscillator:
      return [=](const dvec2& s, double) { return dvec2(s.y, -a * a * s.x); };
    case OdeSystem::pendulum:
      return [=](const dvec2& s, double) { return dvec2(s.y, -a * a * std::sin(s.x)); };
    case OdeSystem::van_der_pol:
      return [=](const dvec2& s, double) { return dvec2(s.y, a * (1 - s.x * s.x) * s.y - s.x); };
    case OdeSystem::driven:
      return [=](const dvec2& s, double t) {
        return dvec2(a * (s.x - std::cos(t)) - std::sin(t), b * s.y);
      };
  }
  return {};
}

OdeResult integrate(const OdeProblem& problem) {
  check_ode_problem(problem);
  OdeResult result;
  for (const OdeInstance& instance : problem.instances) {
    const Step end = problem.method == OdeMethod::dormand_prince ? run_adaptive(problem, instance)
                                                                 : run_fixed(problem, instance);
    result.states.push_back(end.state);
    result.evaluations.push_back(end.evaluations);
  }
  return result;
}

double symplectic_energy(const OdeInstance& instance, const dvec2& state, double step) {
  const double w2 = double(instance.parameters.x) * instance.parameters.x;
  return (state.y * state.y + w2 * state.x * state.x - step * w2 * state.x * state.y) / 2;
}

}  // namespace parity::cpu
