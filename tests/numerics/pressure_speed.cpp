#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "gpu/numerics/conjugate_gradient.h"
#include "gpu/numerics/multigrid.h"
#include "gpu/numerics/relaxation.h"
#include "tests/chart.h"

/// How fast the pressure solvers are, in sweeps of our own Jacobi on the same grid and in the same
/// run, and where over-relaxation converges.
namespace parity {
namespace {

/// The smallest of a few device times.
double best_seconds(gpu::Context& context, int repetitions, const std::function<void()>& prepare,
                    const std::function<void(gpu::Commands&)>& record) {
  double best = 1e30;
  for (int k = 0; k < repetitions; ++k) {
    prepare();
    best = std::min(best, context.run(record).seconds);
  }
  return best;
}

double true_residual(const PressureProblem& problem, const Field& pressure) {
  return largest_magnitude(pressure_residual(problem, pressure)) / largest_magnitude(problem.rhs);
}

Field sum_of(Field a, const Field& b) {
  for (std::size_t i = 0; i < a.values.size(); ++i) a.values[i] += b.values[i];
  return a;
}

ChartData sweeps_to_tolerance(gpu::Context& context) {
  const int side = 128;
  ChartData data;
  Series multigrid{.name = "multigrid CG", .points = {}}, plain{.name = "CG", .points = {}};
  double at_target = 0, residual_at_target = 1, plain_sweeps = 0;
  const PressureProblem problem = make_pressure_problem(ivec3(side), PressureCase::box, 1e-5, 1);
  gpu::PressureSystem system(context, gpu::shape_of(problem));
  gpu::Relaxation jacobi(context, system, gpu::RelaxationMethod::jacobi);
  gpu::ConjugateGradient fast(context, system, gpu::Preconditioner::multigrid);
  gpu::ConjugateGradient slow(context, system, gpu::Preconditioner::none);
  const auto upload = [&](double tolerance) {
    PressureProblem now = problem;
    now.tolerance = tolerance * largest_magnitude(problem.rhs);
    system.upload(context, now);
  };
  const double sweep =
      best_seconds(
          context, 3, [&] { upload(1e-5); },
          [&](gpu::Commands& commands) { jacobi.record_sweeps(commands, 16, 1); }) /
      16;
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5}) {
    const double seconds = best_seconds(
        context, 2, [&] { upload(tolerance); },
        [&](gpu::Commands& commands) { fast.record_solve(commands, 16); });
    const Field pressure = sum_of(system.to_field(system.pressure().read()),
                                  system.to_field(fast.pressure_low().read()));
    at_target = seconds / sweep;
    residual_at_target = true_residual(problem, pressure);
    multigrid.points.push_back(
        {seconds, residual_at_target, std::to_string(system.read_control().iterations) + " steps"});
  }
  // Plain CG in parts, so that no submission is long.
  upload(1e-5);
  double seconds = 0;
  for (int part = 0; part < 40 && system.read_control().done == 0; ++part) {
    seconds += context
                   .run([&](gpu::Commands& commands) {
                     if (part == 0) slow.record_solve(commands, 32);
                     if (part > 0) slow.record_more(commands, 32);
                   })
                   .seconds;
    plain.points.push_back({seconds,
                            double(system.read_control().residual) / largest_magnitude(problem.rhs),
                            std::to_string(system.read_control().iterations) + " steps"});
  }
  plain_sweeps = seconds / sweep;
  data.series = {multigrid, plain};
  data.assertions = {
      {"relative residual reached", residual_at_target, 1.1e-5},
      {"multigrid CG to 1e-5, in Jacobi sweeps", at_target, 110},
      {"plain CG / multigrid CG", plain_sweeps / at_target, 10, Assertion::Relation::at_least}};
  data.settings = {{"grid", "128^3, closed box"},
                   {"Jacobi sweep", std::to_string(1e3 * sweep) + " ms"},
                   {"multigrid CG to 1e-5", std::to_string(at_target) + " sweeps"},
                   {"plain CG to 1e-5", std::to_string(plain_sweeps) + " sweeps"}};
  return data;
}

const Registration speed_chart =
    register_chart({.name = "numerics/pressure_speed",
                    .title = "Pressure of 128^3 cells: residual against time",
                    .x = {.label = "device time", .unit = "s"},
                    .y = {.label = "largest residual", .unit = "largest rhs"},
                    .produce = sweeps_to_tolerance,
                    .pareto = true});

/// Residual after 64 sweeps over the one before, largest value below 1: converges.
double contraction(gpu::Context& context, bool is_jacobi, double omega) {
  PressureProblem problem = make_pressure_problem({16, 16, 1}, PressureCase::open_top, 0, 1);
  problem.max_iterations = 256;
  const double first = largest_magnitude(pressure_residual(problem, problem.guess));
  const PressureAnswer answer = gpu::relaxation(
      context, problem, is_jacobi ? gpu::RelaxationMethod::jacobi : gpu::RelaxationMethod::sor,
      omega);
  const double last = largest_magnitude(pressure_residual(problem, answer.pressure));
  // Beyond 1.5 it does not matter how far.
  return std::isfinite(last) ? std::min(std::pow(last / first, 1.0 / 256), 1.5) : 1.5;
}

const Registration relaxation_map = register_map(
    {.name = "numerics/relaxation",
     .title = "Factor of the residual a sweep on 16 x 16 cells: 0 Jacobi, 1 red-black SOR",
     .x = {.name = "method", .low = 0, .high = 1, .standard = 0, .whole = true},
     .y = {.name = "omega", .low = 0.1, .high = 2.4, .standard = 1},
     .value_label = "factor a sweep",
     .logarithmic = false,
     .border = 1,
     .columns = 2,
     .rows = 24,
     .value = [](gpu::Context& context, double method,
                 double omega) { return contraction(context, method < 0.5, omega); },
     .theory = {{"Jacobi 2 / (1 + rho), SOR 2", [](double method) {
                   return method < 0.5 ? 2 / (1 + std::cos(std::numbers::pi / 32)) : 2.0;
                 }}}});

}  // namespace
}  // namespace parity
