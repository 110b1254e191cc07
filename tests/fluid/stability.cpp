#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "cpu_reference/fluid/advect.h"
#include "cpu_reference/fluid/momentum.h"
#include "geometry/random.h"
#include "gpu/fluid/step.h"
#include "sim/pressure.h"
#include "tests/chart.h"

/// Where explicit viscosity and advection stop being stable. Checklist row 169.
namespace parity {
namespace {

/// A periodic box of 8 cells along each of the first `dimensions` axes that holds the shortest
/// wave: each face the opposite of its neighbours.
FluidProblem shortest_wave(int dimensions) {
  FluidDomain domain{.cells = {8, dimensions > 1 ? 8 : 1, dimensions > 2 ? 8 : 1},
                     .spacing = 0.125};
  for (std::size_t side = 0; side < 6; ++side)
    domain.walls[side].kind = int(side / 2) < dimensions ? WallKind::periodic : WallKind::free_slip;
  FluidProblem problem{.domain = domain, .parameters = {.method = FluidMethod::semi_lagrangian}};
  problem.initial = resting_state(domain);
  Field& u = problem.initial.velocity[0];
  for (int z = 0; z < u.size.z; ++z)
    for (int y = 0; y < u.size.y; ++y)
      for (int x = 0; x < u.size.x; ++x) u(x, y, z) = (x + y + z) % 2 == 0 ? 1 : -1;
  return problem;
}

double largest_speed(const FluidState& state) { return largest_magnitude(state.velocity[0]); }

/// What one explicit step does to the shortest wave, at `number` = viscosity step / h^2.
using Growth = std::function<double(int dimensions, double number)>;

double growth_on_the_reference(int dimensions, double number) {
  FluidProblem problem = shortest_wave(dimensions);
  const double h = problem.domain.spacing;
  FluidState state = problem.initial;
  state.velocity = cpu::diffuse_explicit(problem.domain, state.velocity, 1, number * h * h);
  return largest_speed(state);
}

double growth_on_the_device(gpu::Context& context, int dimensions, double number) {
  FluidProblem problem = shortest_wave(dimensions);
  problem.parameters.viscosity = 1;
  const double h = problem.domain.spacing;
  return largest_speed(gpu::diffuse(context, problem, problem.initial, number * h * h));
}

/// The number at which growth passes 1.
double border(const Growth& growth, int dimensions) {
  double stable = 0, unstable = 4;
  for (int k = 0; k < 30; ++k) {
    const double middle = (stable + unstable) / 2;
    (growth(dimensions, middle) <= 1 + 1e-9 ? stable : unstable) = middle;
  }
  return stable;
}

/// Does a rule for the largest stable step, viscosity step / h^2, hold in every dimension within 2
/// %?
bool is_the_border(const std::function<double(int dimensions)>& rule) {
  for (const int dimensions : {1, 2, 3})
    if (std::abs(border(growth_on_the_reference, dimensions) / rule(dimensions) - 1) > 0.02)
      return false;
  return true;
}

TEST(DiffusionErratum, TheLimitOfTheNotesHoldsInOneDimensionOnly) {
  const auto ours = [](int dimensions) { return 1.0 / (2 * dimensions); };
  const auto of_the_notes = [](int) { return 1.0 / 2; };
  EXPECT_TRUE(is_the_border(ours));
  EXPECT_FALSE(is_the_border(of_the_notes));
  // At the notes' limit the shortest wave grows threefold a step in 2 dimensions, fivefold in 3.
  EXPECT_NEAR(growth_on_the_reference(1, 0.5), 1, 1e-12);
  EXPECT_NEAR(growth_on_the_reference(2, 0.5), 3, 1e-12);
  EXPECT_NEAR(growth_on_the_reference(3, 0.5), 5, 1e-12);
}

const Registration diffusion_map =
    register_map({.name = "fluid/diffusion_stability",
                  .title = "Growth of the shortest wave in a step of explicit viscosity",
                  .x = {.name = "dimensions", .low = 1, .high = 3, .standard = 2, .whole = true},
                  .y = {.name = "viscosity step / h^2", .low = 0.05, .high = 1, .standard = 0.25},
                  .value_label = "growth a step",
                  .border = 1 + 1e-5,
                  .columns = 3,
                  .rows = 19,
                  .value =
                      [](gpu::Context& context, double dimensions, double number) {
                        return growth_on_the_device(context, int(std::lround(dimensions)), number);
                      },
                  .theory = {{"1 / (2 d)", [](double d) { return 1 / (2 * d); }},
                             {"the notes: 1 / 2", [](double) { return 0.5; }}}});

/// Root of the sum of squares: what dispersion alone does not change.
double length_of(const Field& field) {
  double sum = 0;
  for (const double value : field.values) sum += value * value;
  return std::sqrt(sum);
}

/// Random ripples of 1e-4 on a uniform flow through a periodic box, after 60 steps: how much they
/// have grown. Courant number: cells that the flow crosses in a step.
double ripple_growth(gpu::Context& context, FluidMethod method, double courant) {
  FluidDomain domain{.cells = {32, 4, 1}, .spacing = 1.0 / 32};
  for (std::size_t side = 0; side < 6; ++side)
    domain.walls[side].kind = side < 4 ? WallKind::periodic : WallKind::free_slip;
  FluidProblem problem{.domain = domain, .parameters = {.method = method, .divergence = 1}};
  problem.initial = resting_state(domain);
  problem.parameters.fixed_step = courant * domain.spacing;
  Random random(4, 2);
  for (double& u : problem.initial.velocity[0].values) u = 1;
  // Only the speed across varies, along the flow: without divergence, and the flow stays what it
  // is.
  Field& v = problem.initial.velocity[1];
  for (int x = 0; x < v.size.x; ++x) {
    const double ripple = double(random.uniform(-1e-4f, 1e-4f));
    for (int y = 0; y < v.size.y; ++y) v(x, y, 0) = ripple;
  }
  gpu::FluidSimulation simulation(context, problem);
  simulation.run_until(1e9, 12, 60);
  const double growth = length_of(simulation.read().velocity[1]) / length_of(v);
  return std::isfinite(growth) ? std::min(growth, 1e9) : 1e9;
}

const Registration advection_map = register_map(
    {.name = "fluid/advection_stability",
     .title = "Growth of ripples in 60 steps: 0 upwind, 1 central, 2 semi-Lagrangian, 3 MacCormack",
     .x = {.name = "method", .low = 0, .high = 3, .standard = 1, .whole = true},
     .y = {.name = "Courant number", .low = 0.2, .high = 4, .standard = 1},
     .value_label = "growth",
     .border = 1.001,
     .columns = 4,
     .rows = 20,
     .value =
         [](gpu::Context& context, double method, double courant) {
           return ripple_growth(context, FluidMethod(std::lround(method)), courant);
         },
     .theory = {{"upwind 1.26, central sqrt 3 with Runge-Kutta 3; traces: none", [](double method) {
                   return method < 0.5 ? 1.256 : (method < 1.5 ? std::sqrt(3.0) : 4.0);
                 }}}});

/// Velocity error of the Taylor-Green vortex after half a second of viscosity 0.01, against
/// seconds.
Series taylor_green_series(gpu::Context& context, FluidMethod method, const char* name) {
  Series series{.name = name, .points = {}};
  for (const int cells : {8, 16, 32, 64}) {
    FluidProblem problem = taylor_green(cells, 0.01, 2);
    problem.parameters.method = method;
    problem.parameters.courant = 0.8;
    problem.parameters.max_step = 1;  // the Courant number alone sets the step
    gpu::FluidSimulation simulation(context, problem);
    simulation.run_until(0.5, 8);
    simulation.write(problem.initial);
    const double begin = detail::wall_seconds();
    simulation.run_until(0.5, 8);
    const double seconds = detail::wall_seconds() - begin;
    const FaceFields exact = taylor_green_velocity(problem.domain, 0.01, 0.5);
    const FluidState state = simulation.read();
    double error = 0;
    for (std::size_t axis = 0; axis < 2; ++axis)
      for (std::size_t i = 0; i < exact[axis].values.size(); ++i)
        error = std::max(error, std::abs(exact[axis].values[i] - state.velocity[axis].values[i]));
    series.points.push_back({seconds, error, std::to_string(cells) + "^2"});
  }
  return series;
}

const Registration advection_chart = register_chart(
    {.name = "fluid/taylor_green",
     .title = "Taylor-Green vortex: error of the velocity against time, by method",
     .x = {.label = "time", .unit = "s"},
     .y = {.label = "largest error", .unit = "m/s"},
     .produce =
         [](gpu::Context& context) {
           ChartData data;
           data.series = {
               taylor_green_series(context, FluidMethod::upwind, "upwind"),
               taylor_green_series(context, FluidMethod::central, "central"),
               taylor_green_series(context, FluidMethod::semi_lagrangian, "semi-Lagrangian"),
               taylor_green_series(context, FluidMethod::maccormack, "MacCormack")};
           return data;
         },
     .pareto = true});

}  // namespace
}  // namespace parity
