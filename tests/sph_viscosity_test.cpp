#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cpu_reference/sph/step.h"
#include "gpu/sph/step.h"
#include "tests/gpu_context.h"
#include "tests/sph/problems.h"

namespace parity {
namespace {

constexpr int rows = 9;

SphState advanced(const SphProblem& problem, int steps) {
  gpu::SphStep step(test_context(), problem);
  test_context().run([&](gpu::Commands& commands) {
    for (int k = 0; k < steps; ++k) step.record(commands, 1e9);
  });
  return step.read();
}

/// What the free ends do falls by e^(-pi x / sqrt 3) a width (stretching meets three times the
/// viscosity), to 2e-5 in the middle, six widths away; the solver leaves 1e-5 of the speed, which
/// the slowest mode gathers over a few steps.
constexpr double profile_error = 1e-3;

/// Rows are tied to their neighbours alone, so second differences are exact for a parabola: it
/// must come out to the solver's error. Each step of 3 s leaves a twentieth of what differs from
/// it.
TEST(SphViscosity, PoiseuilleFlowIsAParabola) {
  SphProblem problem = sph_test::channel(rows, 0);
  SphParameters& p = problem.parameters;
  constexpr double force = 1e-6;  // so that nothing moves by a rounding of its place
  p.gravity = dvec3(force, 0, 0);
  p.fixed_step = 3;
  p.max_iterations = 300;
  const std::vector<double> profile = sph_test::profile_of(problem, advanced(problem, 4));
  const double viscosity = sph_test::lattice_viscosity(p);
  const double peak = force / (8 * viscosity);
  ASSERT_EQ(profile.size(), std::size_t(rows));
  for (int row = 0; row < rows; ++row) {
    const double y = double(row + 1) / (rows + 1);
    EXPECT_NEAR(profile[std::size_t(row)] / peak, 4 * y * (1 - y), profile_error) << row;
  }
}

/// The series of Couette flow that starts from rest between walls 1 m apart, the upper one at
/// speed 1.
double couette(double y, double viscous_time) {
  double u = y;
  for (int k = 1; k < 60; ++k)
    u += 2 / (k * std::numbers::pi) * (k % 2 == 0 ? 1 : -1) * std::sin(k * std::numbers::pi * y) *
         std::exp(-std::pow(k * std::numbers::pi, 2) * viscous_time);
  return u;
}

/// What implicit Euler steps make of the rows' modes, sin(k pi y), whose rates are
/// 4 nu / s^2 sin^2(k pi s / 2).
double discrete_couette(int row, double viscosity, double dt, int steps) {
  const double s = 1.0 / (rows + 1);
  double u = (row + 1) * s;
  for (int k = 1; k <= rows; ++k) {
    const double angle = k * std::numbers::pi;
    const double rate = 4 * viscosity / (s * s) * std::pow(std::sin(angle * s / 2), 2);
    double amplitude = 0;  // of minus the steady profile
    for (int j = 1; j <= rows; ++j) amplitude -= 2 * s * j * s * std::sin(angle * j * s);
    u += amplitude * std::pow(1 + rate * dt, -steps) * std::sin(angle * (row + 1) * s);
  }
  return u;
}

TEST(SphViscosity, CouetteFlowStartsAsItsSeries) {
  constexpr double speed = 1e-6;
  SphProblem problem = sph_test::channel(rows, speed);
  SphParameters& p = problem.parameters;
  const double viscosity = sph_test::lattice_viscosity(p);
  p.fixed_step = 0.005 / viscosity;
  p.max_iterations = 60;
  for (const int steps : {6, 16}) {
    const std::vector<double> profile = sph_test::profile_of(problem, advanced(problem, steps));
    for (int row = 0; row < rows; ++row) {
      const double u = profile[std::size_t(row)] / speed;
      EXPECT_NEAR(u, discrete_couette(row, viscosity, p.fixed_step, steps), profile_error);
      // Implicit Euler: dt / 2 of the acceleration, at most max |u_tt| t dt / 2 ~ 0.25 dt / t;
      // space: s^2 / 12 of the fourth derivative over the second.
      const double t = 0.005 * steps;
      const double bound = 0.5 * 0.005 / t + 1.0 / 12 / (rows + 1) / (rows + 1) / t;
      EXPECT_NEAR(u, couette(double(row + 1) / (rows + 1), t), bound) << row << " at " << t;
    }
  }
}

/// What slips feels nothing of the wall.
TEST(SphViscosity, WallsThatSlipDoNotDrag) {
  SphProblem problem = sph_test::channel(rows, 1e-6);
  for (vec4& motion : problem.boundary_motions) motion.w = 0;
  problem.parameters.fixed_step = 0.1;
  for (const bool implicit : {false, true}) {
    problem.parameters.implicit_viscosity = implicit;
    // Nothing but the pressure of sound at 1e-6 m/s, 1e-12 m^2/s^2, over a spacing for 0.3 s.
    for (const vec3& v : advanced(problem, 3).velocities) ASSERT_LT(glm::length(v), 1e-11);
  }
}

/// The same flow, by explicit steps far below their border and by implicit ones of the same length.
TEST(SphViscosity, ExplicitAndImplicitStepsAgree) {
  SphProblem problem = sph_test::channel(7, 1e-6);
  SphParameters& p = problem.parameters;
  p.fixed_step = 0.1 * sph_test::viscous_step(p);
  p.max_iterations = 12;
  const std::vector<double> implicit = sph_test::profile_of(problem, advanced(problem, 40));
  p.implicit_viscosity = false;
  const std::vector<double> explicitly = sph_test::profile_of(problem, advanced(problem, 40));
  for (std::size_t row = 0; row < implicit.size(); ++row)
    EXPECT_NEAR(implicit[row] / 1e-6, explicitly[row] / 1e-6, 0.01) << row;
}

/// A hundred times the explicit border: explicit steps leave every bound within a few steps,
/// implicit ones slow the fluid down; what the drop has of momentum stays.
TEST(SphViscosity, ImplicitStepsAreStableWhereExplicitOnesAreNot) {
  SphProblem problem = sph_test::closed_box(8, 1, 100);
  SphParameters& p = problem.parameters;
  p.fixed_step = 100 * sph_test::viscous_step(p);
  p.max_iterations = 40;
  EXPECT_GT(sph_test::speed_growth(test_context(), problem, 8), 1e6);
  p.implicit_viscosity = true;
  EXPECT_LT(sph_test::speed_growth(test_context(), problem, 8), 1);
}

TEST(SphViscosity, TheImplicitSolveKeepsMomentum) {
  SphProblem problem = sph_random_drop(3, 7, 0.5, 3);
  SphParameters& p = problem.parameters;
  p.surface_tension = 0;
  p.sound_speed = 1e-6;
  p.implicit_viscosity = true;
  p.viscosity = 1;
  p.fixed_step = 50 * sph_test::viscous_step(p);
  constexpr int steps = 3;
  const SphMeasures before = measure(p, problem.initial);
  const SphMeasures after = measure(p, advanced(problem, steps));
  EXPECT_LT(after.kinetic_energy, 0.5 * before.kinetic_energy);
  // Each iteration adds directions whose sums round by n u of what the matrix makes of them, which
  // is up to twice the stiffness; their lengths add up to no more than some speeds.
  const double bound = steps * before.mass * sph_test::u * 60 * (1 + 2 * 50) * before.max_speed;
  EXPECT_LT(glm::length(after.momentum - before.momentum), bound);
}

}  // namespace
}  // namespace parity
