#include "tests/fluid/step_error.h"

#include <cmath>
#include <functional>
#include <utility>

#include "tests/chart.h"

/// What steps chosen by their error cost and give, beside steps by CFL. Those follow the speed, as
/// the error does here, so control is no cheaper: it finds the length that a tolerance asks for
/// without a Courant number being known, and pays for that with the whole step beside the halves.
namespace parity {
namespace {

using namespace step_error_test;

/// Hot smoke from rest, violent at first.
FluidProblem hot_start() {
  FluidProblem problem = smoke_plume(16, 2);
  problem.solids.clear();
  problem.sources.clear();
  for (int y = 4; y < 10; ++y)
    for (int x = 5; x < 11; ++x) problem.initial.temperature(x, y, 0) = 30;
  problem.parameters.divergence = 1e-5;
  problem.parameters.max_iterations = 60;
  problem.parameters.viscosity = 0.002;
  problem.parameters.max_step = 1;
  return problem;
}

struct Flow {
  const char* name;
  FluidProblem problem;
  std::vector<double> courants, tolerances;
  std::function<double(const FluidState&)> error;
};

Series by_courant(gpu::Context& context, const Flow& flow) {
  Series series{.name = std::string(flow.name) + ", by CFL", .points = {}};
  FluidProblem problem = flow.problem;
  for (const double courant : flow.courants) {
    problem.parameters.courant = courant;
    const FluidState state = on_device(context, problem, 1).state;
    series.points.push_back({double(state.steps), flow.error(state), ""});
  }
  return series;
}

/// Each step is three: one whole and two halves, as is each refused one.
Series by_error(gpu::Context& context, const Flow& flow) {
  Series series{.name = std::string(flow.name) + ", by error", .points = {}};
  FluidProblem problem = flow.problem;
  for (const double tolerance : flow.tolerances) {
    problem.parameters.step_error = tolerance;
    const Outcome outcome = on_device(context, problem, 1);
    const double made = 3.0 * (outcome.state.steps + double(outcome.control.refused));
    series.points.push_back({made, flow.error(outcome.state), ""});
  }
  return series;
}

/// Slope between the ends of a series, log over log.
double slope_of(const Series& series) {
  const Point &a = series.points.front(), &b = series.points.back();
  return std::log(b.y / a.y) / std::log(b.x / a.x);
}

/// Steps made by error over those by CFL that err as much, in the middle of the series.
double cost_of(const Series& by_cfl, const Series& controlled) {
  const Point& here = controlled.points[controlled.points.size() / 2];
  const Point& there = by_cfl.points[by_cfl.points.size() / 2];
  return here.x / (there.x * std::pow(here.y / there.y, 1 / slope_of(by_cfl)));
}

ChartData compare(gpu::Context& context) {
  FluidProblem hot = hot_start();
  hot.parameters.fixed_step = 1.0 / 1024;
  const FluidState exact = on_device(context, hot, 1).state;
  const Flow vortex{"vortex",
                    decaying_vortex(0),
                    {0.8, 0.4, 0.2, 0.1, 0.05},
                    {1e-3, 3e-4, 1e-4, 3e-5, 1e-5},
                    vortex_error};
  const Flow plume{
      "hot start",
      hot_start(),
      {1.6, 0.8, 0.4, 0.2, 0.1, 0.05},
      {1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4},
      [&](const FluidState& state) { return flows_apart(state.velocity, exact.velocity); }};
  ChartData data;
  for (const Flow& flow : {vortex, plume}) {
    data.series.push_back(by_courant(context, flow));
    data.series.push_back(by_error(context, flow));
  }
  const std::vector<Series>& all = data.series;
  data.assertions = {
      {"vortex, by error: slope of error over steps, theory -1", slope_of(all[1]), -0.8},
      {"vortex: steps by error over steps by CFL of equal error", cost_of(all[0], all[1]), 2},
      {"hot start: steps by error over steps by CFL of equal error", cost_of(all[2], all[3]), 4}};
  data.settings = {{"flows",
                    "MacCormack; vortex 16^2 against the closed form; hot smoke 16 x 32 "
                    "against 1024 even steps; both after 1 s"},
                   {"steps", "by error: three for each that is tried, 1 whole and 2 halves"}};
  return data;
}

const Registration registration =
    register_chart({.name = "fluid/step_error",
                    .title = "Error of grid fluids against steps made, by CFL and by error",
                    .x = {.label = "steps made"},
                    .y = {.label = "largest error of the velocity", .unit = "m/s"},
                    .produce = compare,
                    .fit_slopes = true});

}  // namespace
}  // namespace parity
