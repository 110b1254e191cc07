#include "tests/fluid/random_scenes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/chart.h"

namespace parity {
namespace {

constexpr int scene_count = 100;
constexpr double run_seconds = 0.2;

/// A step of about eight times what Runge-Kutta 3 takes: Courant 1.73 central, 1.25 upwind.
double reckless_ratio(gpu::Context& context, FluidProblem problem) {
  problem.parameters.courant = 8;
  return speed_over_bound(context, problem, run_seconds);
}

ChartData sweep(gpu::Context& context) {
  ChartData data;
  Series adaptive{.name = "adaptive step", .points = {}},
      reckless{.name = "eight times it", .points = {}};
  double largest = 0;
  std::ptrdiff_t broken = 0;
  for (int seed = 1; seed <= scene_count; ++seed) {
    const FluidProblem problem = random_fluid(std::uint64_t(seed));
    const double ratio = speed_over_bound(context, problem, run_seconds);
    adaptive.points.push_back({double(seed), std::min(ratio, 1e3)});
    largest = std::max(largest, ratio);
    // Some of those that difference fluxes, to show that the measure can fail.
    if (is_split(problem.parameters.method) || reckless.points.size() == 10) continue;
    const double beyond = reckless_ratio(context, problem);
    reckless.points.push_back({double(seed), std::min(beyond, 1e3)});
    broken += beyond > 1 ? 1 : 0;
  }
  data.assertions = {
      {"largest speed (L2) over what forces and walls can give, 100 scenes", largest, 1},
      {"of 10 scenes, those beyond it at eight times the step", double(broken), 3,
       Assertion::Relation::at_least}};
  data.series = {std::move(adaptive),
                 std::move(reckless),
                 {.name = "bound of energy",
                  .points = {{1, 1}, {scene_count, 1}},
                  .kind = Series::Kind::theory}};
  data.settings = {{"scenes", "random walls, solids, forces, viscosities and methods; 0.2 s"}};
  return data;
}

const Registration registration =
    register_chart({.name = "fluid/random_scenes",
                    .title = "The adaptive step stays stable on grids: 100 random scenes",
                    .x = {.label = "scene", .logarithmic = false},
                    .y = {.label = "speed / what forces and walls can give"},
                    .produce = sweep});

}  // namespace
}  // namespace parity
