#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "gpu/ode/integrate.h"
#include "tests/gpu_context.h"
#include "tests/ode/problems.h"
#include "tests/shared_data.h"

namespace parity {
namespace {

using namespace ode_test;

using Integrate = std::function<OdeResult(const OdeProblem&)>;
OdeResult on_device(const OdeProblem& problem) { return gpu::integrate(test_context(), problem); }

OdeProblem oscillator(OdeMethod method, double step, std::uint32_t steps) {
  return {.method = method,
          .system = OdeSystem::oscillator,
          .instances = {{{1, 0}, {1, 0}}},
          .step = step,
          .steps = steps};
}

double error_after(const Integrate& integrate, const OdeProblem& problem) {
  return glm::length(integrate(problem).states[0] - *ode_exact(problem.system, problem.instances[0],
                                                               problem.step * problem.steps));
}

/// From two steps, so small that the next order does not show, so large that float does not.
double order_of(const Integrate& integrate, OdeMethod method, double step) {
  const double coarse = error_after(integrate, oscillator(method, step, std::uint32_t(4 / step)));
  const double fine = error_after(integrate, oscillator(method, step / 2, std::uint32_t(8 / step)));
  return std::log2(coarse / fine);
}

TEST(Ode, MethodsHaveTheirOrdersOnBothSides) {
  struct Case {
    OdeMethod method;
    double order, step, device_step;
  };
  for (const Case& c : {Case{OdeMethod::explicit_euler, 1, 0.0078125, 0.0078125},
                        {OdeMethod::implicit_euler, 1, 0.0078125, 0.0078125},
                        {OdeMethod::symplectic_euler, 1, 0.0078125, 0.0078125},
                        {OdeMethod::trapezoid, 2, 0.03125, 0.03125},
                        {OdeMethod::midpoint, 2, 0.03125, 0.03125},
                        {OdeMethod::rk4, 4, 0.03125, 0.25}}) {
    EXPECT_NEAR(order_of(cpu::integrate, c.method, c.step), c.order, 0.05) << name_of(c.method);
    EXPECT_NEAR(order_of(on_device, c.method, c.device_step), c.order, 0.1) << name_of(c.method);
  }
}

TEST(Ode, TheAdaptiveErrorFollowsTheTolerance) {
  for (const OdeSystem system : {OdeSystem::oscillator, OdeSystem::driven}) {
    OdeProblem problem{.method = OdeMethod::dormand_prince,
                       .system = system,
                       .instances = {{{0.3f, 0.4f}, {-2, -1}}},
                       .step = 0.01,
                       .steps = 1000};
    problem.tolerance = 1e-4;
    const double coarse = error_after(cpu::integrate, problem);
    const std::uint32_t few = cpu::integrate(problem).evaluations[0];
    problem.tolerance = 1e-10;
    const double fine = error_after(cpu::integrate, problem);
    const std::uint32_t many = cpu::integrate(problem).evaluations[0];
    EXPECT_LT(coarse, 1e-2);
    EXPECT_NEAR(std::log10(coarse / fine), 6, 1.5);
    // A method of fifth order takes 10^(6/5) = 16 times the steps.
    EXPECT_NEAR(std::log10(double(many) / few), 1.2, 0.35);
  }
}

TEST(Ode, TheDeviceKeepsATightTolerance) {
  OdeProblem problem{.method = OdeMethod::dormand_prince,
                     .system = OdeSystem::driven,
                     .instances = {{{0.3f, 0.4f}, {-2, -1}}},
                     .step = 0.01,
                     .steps = 1000,
                     .tolerance = 1e-6};
  EXPECT_LT(error_after(on_device, problem), 1e-5);
}

/// |R(z)| of one step over a grid of z, against the formula.
TEST(Ode, OneStepMultipliesByTheStabilityFunction) {
  for (const OdeMethod method : {OdeMethod::explicit_euler, OdeMethod::implicit_euler,
                                 OdeMethod::trapezoid, OdeMethod::midpoint, OdeMethod::rk4}) {
    OdeProblem problem{.method = method, .system = OdeSystem::linear, .step = 1, .steps = 1};
    for (int y = 0; y < 8; ++y)
      for (int x = -8; x < 4; ++x)
        problem.instances.push_back({{1, 0}, {0.5f * float(x) + 0.125f, 0.5f * float(y)}});
    const OdeResult reference = cpu::integrate(problem);
    const OdeResult device = on_device(problem);
    for (std::size_t i = 0; i < problem.instances.size(); ++i) {
      const vec2 z = problem.instances[i].parameters;
      const double want = amplification(method, z.x, z.y);
      EXPECT_NEAR(glm::length(reference.states[i]), want, 1e-6 * (1 + want));
      EXPECT_NEAR(glm::length(device.states[i]), want, 1e-5 * (1 + want)) << z.x << " " << z.y;
    }
  }
}

double grown(OdeMethod method, double x, double y) {
  const OdeProblem problem{.method = method,
                           .system = OdeSystem::linear,
                           .instances = {{{1, 0}, {float(x), float(y)}}},
                           .step = 1,
                           .steps = 1};
  return glm::length(cpu::integrate(problem).states[0]);
}

/// Where |R| crosses 1 between two points, by bisection on what the code does.
double border_between(OdeMethod method, dvec2 in, dvec2 out) {
  for (int round = 0; round < 30; ++round) {
    const dvec2 middle = (in + out) / 2.0;
    (grown(method, middle.x, middle.y) <= 1 ? in : out) = middle;
  }
  return glm::length(in);
}

TEST(Ode, StabilityEndsWhereTheoryPutsIt) {
  EXPECT_NEAR(border_between(OdeMethod::explicit_euler, {-1, 0}, {-5, 0}), 2, 1e-5);
  EXPECT_NEAR(border_between(OdeMethod::midpoint, {-1, 0}, {-5, 0}), 2, 1e-5);
  EXPECT_NEAR(border_between(OdeMethod::rk4, {-1, 0}, {-5, 0}), 2.785293563405282, 1e-5);
  EXPECT_NEAR(border_between(OdeMethod::rk4, {0, 1}, {0, 5}), 2 * std::numbers::sqrt2, 1e-5);
  // Nothing of the imaginary axis is stable for explicit Euler and midpoint.
  EXPECT_GT(grown(OdeMethod::explicit_euler, 0, 0.01), 1);
  EXPECT_GT(grown(OdeMethod::midpoint, 0, 0.1), 1);
  // A-stable, but the trapezoid does not damp what is stiff, it rings; implicit Euler does.
  EXPECT_GT(grown(OdeMethod::trapezoid, -1e4, 0), 0.999);
  EXPECT_LT(grown(OdeMethod::trapezoid, -1e4, 0), 1);
  EXPECT_LT(grown(OdeMethod::implicit_euler, -1e4, 0), 1e-3);
}

/// Whether a criterion for explicit Euler says the same as 200 steps of it.
bool predicts_stability(const std::function<bool(double)>& criterion) {
  for (const double z : {-0.1, -0.9, -1.5, -1.99, -2.01, -2.5, -10.0, 0.01, 1.0}) {
    const OdeProblem problem{.method = OdeMethod::explicit_euler,
                             .system = OdeSystem::linear,
                             .instances = {{{1, 0}, {float(z), 0}}},
                             .step = 1,
                             .steps = 200};
    const bool stable = glm::length(cpu::integrate(problem).states[0]) < 1;
    if (criterion(z) != stable) return false;
  }
  return true;
}

TEST(OdeErratum, TheStabilityTestNeedsItsBars) {
  EXPECT_TRUE(predicts_stability([](double z) { return std::abs(1 + z) < 1; }));
  EXPECT_FALSE(predicts_stability([](double z) { return 1 + z < 1; }));
}

using Energy = std::function<double(const OdeInstance&, const dvec2&, double step)>;

/// Largest relative change of an energy over 1e5 symplectic Euler steps.
double swing(const Integrate& integrate, const Energy& energy, double step) {
  OdeProblem problem = oscillator(OdeMethod::symplectic_euler, step, 0);
  double worst = 0;
  const double start = energy(problem.instances[0], {1, 0}, step);
  for (const std::uint32_t steps : {3u, 7u, 8u, 16u, 31u, 97u, 1000u, 33333u, 99999u, 100000u}) {
    problem.steps = steps;
    const dvec2 state = integrate(problem).states[0];
    worst = std::max(worst, std::abs(energy(problem.instances[0], state, step) / start - 1));
  }
  return worst;
}

/// Whether what is claimed to be preserved is, to the rounding of 1e5 steps in double.
bool preserved(const Energy& energy) { return swing(cpu::integrate, energy, 0.1) < 1e-9; }

double plain_energy(const OdeInstance& instance, const dvec2& state, double) {
  return ode_energy(OdeSystem::oscillator, instance, state);
}

TEST(OdeErratum, SymplecticEulerPreservesAnotherEnergy) {
  EXPECT_TRUE(preserved(cpu::symplectic_energy));
  EXPECT_FALSE(preserved(plain_energy));
}

/// With w h = 0.1 the energy swings by 5 %, at 1 by 100 %; beyond 2 it explodes.
TEST(OdeErratum, TheEnergySwingsButStays) {
  EXPECT_NEAR(swing(cpu::integrate, plain_energy, 0.1), 0.05, 0.01);
  EXPECT_NEAR(swing(on_device, plain_energy, 0.1), 0.05, 0.01);
  EXPECT_LT(swing(on_device, cpu::symplectic_energy, 0.1), 1e-3);
  const auto largest = [](double step) {
    return glm::length(
        cpu::integrate(oscillator(OdeMethod::symplectic_euler, step, 3000)).states[0]);
  };
  EXPECT_LT(largest(1.99), 50);
  EXPECT_GT(largest(2.01), 1e10);
}

TEST(Ode, EnergyOverAHundredThousandSteps) {
  const auto energy = [](OdeMethod method) {
    const OdeProblem problem = oscillator(method, 0.01, 100000);
    return 2 * ode_energy(problem.system, problem.instances[0], cpu::integrate(problem).states[0]);
  };
  // A step multiplies the energy by 1 + h^2, by its inverse, by 1.
  EXPECT_NEAR(std::log(energy(OdeMethod::explicit_euler)), 1e5 * std::log1p(1e-4), 1e-6);
  EXPECT_NEAR(std::log(energy(OdeMethod::implicit_euler)), -1e5 * std::log1p(1e-4), 1e-6);
  EXPECT_NEAR(energy(OdeMethod::trapezoid), 1, 1e-9);
  EXPECT_NEAR(energy(OdeMethod::symplectic_euler), 1, 0.0101);
}

TEST(Ode, ThePendulumHasThePeriodOfTheEllipticIntegral) {
  const auto path = shared_data("reference/pendulum_period_ratio.csv");
  if (!path) GTEST_SKIP() << "skipped: no shared data";
  std::ifstream file(*path);
  std::string line;
  std::getline(file, line);
  int rows = 0;
  while (std::getline(file, line)) {
    double degrees = 0, ratio = 0;
    char comma = 0;
    std::istringstream(line) >> degrees >> comma >> ratio;
    if (degrees > 170) continue;
    // After a whole period the pendulum is back.
    const double period = 2 * std::numbers::pi * ratio;
    const auto start = float(degrees / 180 * std::numbers::pi);
    const OdeProblem problem{.method = OdeMethod::dormand_prince,
                             .system = OdeSystem::pendulum,
                             .instances = {{{start, 0}, {1, 0}}},
                             .step = period / 100,
                             .steps = 100,
                             .tolerance = 1e-11};
    const dvec2 state = cpu::integrate(problem).states[0];
    EXPECT_NEAR(state.x, start, 1e-6) << degrees;
    EXPECT_NEAR(state.y, 0, 1e-5) << degrees;
    ++rows;
  }
  EXPECT_GT(rows, 10);
}

TEST(Ode, EdgesOfTheInput) {
  OdeProblem none = oscillator(OdeMethod::rk4, 0.1, 10);
  none.instances.clear();
  EXPECT_TRUE(on_device(none).states.empty());
  EXPECT_TRUE(cpu::integrate(none).states.empty());
  for (const double step : {0.0, -1.0, std::nan(""), double(INFINITY)}) {
    EXPECT_THROW(on_device(oscillator(OdeMethod::rk4, step, 1)), std::invalid_argument);
    EXPECT_THROW(cpu::integrate(oscillator(OdeMethod::rk4, step, 1)), std::invalid_argument);
  }
  OdeProblem wild = oscillator(OdeMethod::rk4, 0.1, 10);
  wild.instances[0].initial.x = NAN;
  EXPECT_THROW(on_device(wild), std::invalid_argument);
}

}  // namespace
}  // namespace parity
