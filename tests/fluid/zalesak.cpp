#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "gpu/fluid/step.h"
#include "tests/chart.h"

/// Zalesak's disc: a disc with a slot turns once around the middle of the box and should be what it
/// was. Source: Zalesak 1979.
namespace parity {
namespace {

struct DiscMethod {
  std::string name;
  FluidMethod method;
  BackTrace back_trace;
};

/// One in the disc of radius 0.15 around (0.5, 0.75) but for a slot 0.05 wide and 0.25 high.
double disc_at(dvec3 p) {
  const bool in_slot = std::abs(p.x - 0.5) < 0.025 && p.y < 0.85;
  return glm::length(dvec2(p.x - 0.5, p.y - 0.75)) < 0.15 && !in_slot ? 1 : 0;
}

/// A box 1 m wide that turns once a second. The velocity is linear: interpolation is exact.
FluidProblem turning_disc(int cells, const DiscMethod& method) {
  FluidProblem problem{.domain = {.cells = {cells, cells, 1}, .spacing = 1.0 / cells},
                       .parameters = {.method = method.method, .back_trace = method.back_trace}};
  for (Wall& wall : problem.domain.walls) wall.kind = WallKind::free_slip;
  problem.initial = resting_state(problem.domain);
  for (int axis = 0; axis < 2; ++axis) {
    Field& u = problem.initial.velocity[std::size_t(axis)];
    for (int y = 0; y < u.size.y; ++y)
      for (int x = 0; x < u.size.x; ++x) {
        const dvec3 p = point_position(problem.domain, axis, {x, y, 0});
        u(x, y, 0) = 2 * std::numbers::pi * (axis == 0 ? 0.5 - p.y : p.x - 0.5);
      }
  }
  for (int y = 0; y < cells; ++y)
    for (int x = 0; x < cells; ++x)
      problem.initial.smoke(x, y, 0) = disc_at(point_position(problem.domain, -1, {x, y, 0}));
  return problem;
}

struct Turned {
  double seconds = 0;  ///< of the device
  double error = 0;    ///< sum of the differences over that of the disc
  double outside = 0;  ///< how far values leave 0 to 1
};

/// One turn in steps that carry the disc's far end 1.3 cells.
Turned turn_once(gpu::Context& context, int cells, const DiscMethod& method) {
  const FluidProblem problem = turning_disc(cells, method);
  gpu::FluidSimulation simulation(context, problem);
  const int steps = 2 * cells;
  const double before = context.device_seconds();
  FluidState state;
  for (int k = 0; k < steps; ++k)
    state = simulation.run_part(gpu::FluidSimulation::Part::advection, float(1.0 / steps));
  Turned result{.seconds = context.device_seconds() - before};
  double disc = 0;
  for (std::size_t i = 0; i < state.smoke.values.size(); ++i) {
    const double got = state.smoke.values[i], want = problem.initial.smoke.values[i];
    result.error += std::abs(got - want);
    result.outside = std::max({result.outside, -got, got - 1});
    disc += want;
  }
  result.error /= disc;
  return result;
}

ChartData disc_errors(gpu::Context& context) {
  const std::vector<DiscMethod> methods = {
      {"semi-Lagrangian, order 2 back", FluidMethod::semi_lagrangian, BackTrace::rk2},
      {"semi-Lagrangian, order 3 back", FluidMethod::semi_lagrangian, BackTrace::rk3},
      {"MacCormack, order 2 back", FluidMethod::maccormack, BackTrace::rk2},
      {"MacCormack, order 3 back", FluidMethod::maccormack, BackTrace::rk3}};
  ChartData data;
  double outside = 0;
  for (const DiscMethod& method : methods) {
    Series series{.name = method.name, .points = {}};
    for (const int cells : {32, 64, 128}) {
      const Turned turned = turn_once(context, cells, method);
      series.points.push_back({turned.seconds, turned.error, std::to_string(cells) + "^2"});
      outside = std::max(outside, turned.outside);
    }
    data.series.push_back(series);
  }
  data.assertions = {{"error of MacCormack / of semi-Lagrangian, both on 128^2",
                      data.series[2].points[2].y / data.series[0].points[2].y, 0.75},
                     {"values leave 0 to 1 by", outside, 1e-6}};
  data.settings = {{"disc", "radius 0.15, slot 0.05 x 0.25, one turn"},
                   {"steps", "2 for each cell along a side"}};
  return data;
}

const Registration disc_chart =
    register_chart({.name = "fluid/zalesak",
                    .title = "Zalesak's disc after one turn: what is not where it was",
                    .x = {.label = "device time", .unit = "s"},
                    .y = {.label = "error / disc"},
                    .produce = disc_errors,
                    .pareto = true});

}  // namespace
}  // namespace parity
