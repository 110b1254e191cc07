#include <algorithm>
#include <cmath>

#include "cpu_reference/sph/step.h"
#include "tests/chart.h"
#include "tests/sph/problems.h"

namespace parity {
namespace {

constexpr int scene_count = 100;

ChartData sweep(gpu::Context& context) {
  ChartData data;
  Series adaptive{.name = "adaptive step"}, twice{.name = "twice the stable step"};
  for (int seed = 1; seed <= scene_count; ++seed) {
    SphProblem problem = sph_random_scene(std::uint64_t(seed));
    adaptive.points.push_back({double(seed), sph_test::energy_over_finer(context, problem)});
    if (seed % 10 != 0) continue;  // a tenth of them shows that the measure can fail
    problem.parameters.fixed_step = 2 * cpu::sph_stable_step(problem.parameters);
    twice.points.push_back({double(seed), sph_test::energy_over_finer(context, problem)});
  }
  const double bound = sph_test::energy_bound(SphParameters().courant);
  std::vector<double> ratios;
  for (const Point& p : adaptive.points) ratios.push_back(p.y);
  std::ranges::sort(ratios);
  const auto broken =
      std::ranges::count_if(twice.points, [&](const Point& p) { return p.y > bound; });
  data.assertions = {
      {"largest energy over that of a quarter of the step, 100 scenes", ratios.back(), bound},
      {"of 10 scenes, those beyond the bound at twice the stable step", double(broken), 5,
       Assertion::Relation::at_least}};
  data.settings = {{"in the middle of the scenes",
                    short_number(std::round(1e4 * ratios[ratios.size() / 2]) / 1e4)}};
  data.series = {std::move(adaptive),
                 std::move(twice),
                 {.name = "bound of kick and drift",
                  .points = {{1, bound}, {scene_count, bound}},
                  .kind = Series::Kind::theory}};
  return data;
}

const Registration registration =
    register_chart({.name = "sph/adaptive_scenes",
                    .title = "The adaptive step stays stable: 100 random scenes",
                    .x = {.label = "scene", .logarithmic = false},
                    .y = {.label = "largest energy / that of a quarter of the step"},
                    .produce = sweep});

}  // namespace
}  // namespace parity
