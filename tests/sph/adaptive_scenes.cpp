#include <algorithm>
#include <cmath>

#include "cpu_reference/sph/step.h"
#include "gpu/sph/step.h"
#include "tests/chart.h"

namespace parity {
namespace {

constexpr int scene_count = 100;

/// Largest speed, in speeds of sound, seen at ten times of a run; infinite if it breaks down.
/// Scenes begin below 0.15 and fall for less than 0.1, so a stable run stays below 1, and one
/// beyond the border of stability leaves it by powers of ten.
double largest_speed(gpu::Context& context, const SphProblem& problem) {
  constexpr int looks = 10;
  gpu::SphStep step(context, problem);
  double largest = 0;
  for (int look = 1; look <= looks; ++look) {
    try {
      gpu::advance(context, step, problem.duration * look / looks, 20000);
    } catch (const gpu::Error&) {
      return 1e6;
    }
    const double speed = measure(problem.parameters, step.read()).max_speed;
    if (!std::isfinite(speed)) return 1e6;
    largest = std::max(largest, speed / problem.parameters.sound_speed);
  }
  return std::min(largest, 1e6);
}

ChartData sweep(gpu::Context& context) {
  ChartData data;
  Series adaptive{.name = "adaptive step"}, twice{.name = "twice the stable step"};
  for (int seed = 1; seed <= scene_count; ++seed) {
    SphProblem problem = sph_random_scene(std::uint64_t(seed));
    adaptive.points.push_back({double(seed), largest_speed(context, problem)});
    if (seed % 10 != 0) continue;  // a tenth of them shows that the measure can fail
    problem.parameters.fixed_step = 2 * cpu::sph_stable_step(problem.parameters);
    twice.points.push_back({double(seed), largest_speed(context, problem)});
  }
  const auto by_height = [](const Point& a, const Point& b) { return a.y < b.y; };
  const double worst = std::ranges::max_element(adaptive.points, by_height)->y;
  const auto broken = std::ranges::count_if(twice.points, [](const Point& p) { return p.y > 1; });
  data.assertions = {{"largest speed / speed of sound over 100 scenes, adaptive step", worst, 1},
                     {"of 10 scenes, those above 1 at twice the stable step", double(broken), 5,
                      Assertion::Relation::at_least}};
  data.series = {
      std::move(adaptive),
      std::move(twice),
      {.name = "sound", .points = {{1, 1}, {scene_count, 1}}, .kind = Series::Kind::theory}};
  return data;
}

const Registration registration =
    register_chart({.name = "sph/adaptive_scenes",
                    .title = "The adaptive step stays stable: 100 random scenes",
                    .x = {.label = "scene", .logarithmic = false},
                    .y = {.label = "largest speed / speed of sound"},
                    .produce = sweep});

}  // namespace
}  // namespace parity
