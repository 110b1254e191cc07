#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cpu_reference/fluid/liquid.h"
#include "cpu_reference/fluid/step.h"
#include "gpu/fluid/step.h"
#include "tests/chart.h"
#include "tests/fluid/fluid_fields.h"
#include "tests/stage.h"

/// Sparse fluids: only tiles near what moves are computed.
namespace parity {
namespace {

using Problem = FluidStepProblem;
using Cpu = CpuMethod<Problem, FluidState>;
using Gpu = GpuMethod<Problem, FluidState>;

/// Sets what lies outside of a box, in parts of the domain, to rest.
void keep_inside(FluidProblem& problem, dvec3 low, dvec3 high) {
  FluidState& state = problem.initial;
  const dvec3 size = problem.domain.spacing * dvec3(problem.domain.cells);
  const auto keep = [&](int axis, Field& field) {
    for (int z = 0; z < field.size.z; ++z)
      for (int y = 0; y < field.size.y; ++y)
        for (int x = 0; x < field.size.x; ++x) {
          const dvec3 at = point_position(problem.domain, axis, {x, y, z}) / size;
          if (glm::any(glm::lessThan(at, low)) || glm::any(glm::greaterThan(at, high)))
            field(x, y, z) = 0;
        }
  };
  for (int axis = 0; axis < 3; ++axis) keep(axis, state.velocity[std::size_t(axis)]);
  keep(-1, state.smoke);
  keep(-1, state.temperature);
}

/// Random smoke in a corner of a box, by kinds as random_fluid_step; 3: a liquid.
Problem sparse_step(const Setting& setting) {
  const bool liquid = setting.count("kind") == 3;
  Problem problem = random_fluid_step(setting);
  FluidProblem& fluid = problem.fluid;
  for (FluidSolid& solid : fluid.solids) solid.velocity = dvec3(0);
  fluid.sources[0].radius = 0.06;
  if (liquid) {
    fluid = dam_break(std::max(setting.count("side") / 3, 2), 1, setting.count("dimensions"));
    fluid.parameters.max_iterations = 60;
    fluid.parameters.divergence = 1e-4;
    for (std::size_t i = 0; i < fluid.initial.particles.count(); ++i) {
      const vec3 x = 3.0f * fluid.initial.particles.positions[i];
      fluid.initial.particles.velocities[i] = {std::sin(x.y), std::cos(x.x), 0};
    }
  }
  fluid.parameters.sparse = true;
  fluid.parameters.courant = 1;
  if (!liquid) keep_inside(fluid, dvec3(0.5, 0.55, 0), dvec3(0.9, 0.85, 1));
  return problem;
}

double distance(const Problem& p, const FluidState& got, const FluidState& want) {
  if (got.active != want.active) return 1e9;
  if (!is_liquid(p.fluid.parameters.method)) return states_apart(got, want);
  return particles_apart(p.fluid, got, want);
}

const Registration sparse_registration = register_stage<Problem, FluidState>(
    {.name = "fluid/sparse",
     .title = "One step of a fluid in active tiles only",
     .source = "notes 10.4; Museth 2013 for sparse grids",
     .rows = {167},
     .axes = {{.name = "side", .low = 9, .high = 26, .standard = 20, .whole = true},
              {.name = "dimensions", .low = 2, .high = 3, .standard = 3, .whole = true},
              {.name = "kind", .low = 0, .high = 3, .standard = 1, .whole = true, .each = true},
              {.name = "seconds",
               .unit = "s",
               .low = 1e-3,
               .high = 0.02,
               .standard = 0.01,
               .logarithmic = true}},
     .problem = sparse_step,
     .cpu = {Cpu{.solve =
                     [](const Problem& p) {
                       return is_liquid(p.fluid.parameters.method)
                                  ? cpu::liquid_step(p.fluid, p.fluid.initial, p.seconds)
                                  : cpu::step(p.fluid, p.fluid.initial, p.seconds);
                     }}},
     .gpu = {Gpu{.solve =
                     [](gpu::Context& context, const Problem& p) {
                       return gpu::step(context, p.fluid, p.fluid.initial, p.seconds);
                     }}},
     .distance = distance,
     .tolerance = [](const Problem& p) { return 3 * flow_tolerance(p, 3 * 60 * 2.6); },
     .why =
         "as fluid/step and fluid/liquid: both sides leave the divergence asked for, which feeds "
         "at most 2 D L of flow; traces of up to 2.6 cells through values that change by their "
         "size from cell to cell. Which cells are active must agree",
     .chart_axes = {"side"}});

/// A cube of `cells` a side in which a ball of hot smoke has a part of the room, beside a sphere.
FluidProblem ball_of_smoke(int cells, double part) {
  FluidProblem problem = smoke_plume(8, 3);
  problem.domain.cells = ivec3(cells);
  problem.domain.spacing = 1.0 / cells;
  problem.initial = resting_state(problem.domain);
  problem.sources.clear();
  problem.solids[0] = {.center = {0.5, 0.92, 0.5}, .half = dvec3(0.05)};
  problem.parameters.courant = 1;
  problem.parameters.busy_speed = 0.3;
  problem.parameters.max_iterations = 14;  // suffice; what is not needed is skipped, but launched
  const double radius = std::cbrt(part * 3 / (4 * 3.14159265));
  for (int z = 0; z < cells; ++z)
    for (int y = 0; y < cells; ++y)
      for (int x = 0; x < cells; ++x) {
        if (glm::distance(point_position(problem.domain, -1, {x, y, z}), dvec3(0.5)) > radius)
          continue;
        problem.initial.smoke(x, y, z) = 1;
        problem.initial.temperature(x, y, z) = 60;
      }
  return problem;
}

struct TimedSteps {
  double seconds = 0;  ///< of the quickest step but the first
  FluidState state;
};

/// What a submission costs: seconds of the device; of a software device those that its threads had
/// of the processors, which what else runs there changes least.
double cost_of(gpu::Context& context, const std::function<void(gpu::Commands&)>& record) {
  const std::clock_t before = std::clock();
  const double seconds = context.run(record).seconds;
  if (context.info().type != "cpu") return seconds;
  return double(std::clock() - before) / CLOCKS_PER_SEC;
}

/// Three steps of each problem, in turn, so that what else the machine does befalls all of them.
std::vector<TimedSteps> three_steps(gpu::Context& context,
                                    const std::vector<FluidProblem>& problems) {
  std::vector<std::unique_ptr<gpu::FluidSimulation>> simulations;
  for (const FluidProblem& problem : problems)
    simulations.push_back(std::make_unique<gpu::FluidSimulation>(context, problem));
  std::vector<TimedSteps> results(problems.size(), TimedSteps{.seconds = 1e9, .state = {}});
  for (int k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < problems.size(); ++i) {
      const double seconds =
          cost_of(context, [&](gpu::Commands& commands) { simulations[i]->record_step(commands); });
      if (k > 0) results[i].seconds = std::min(seconds, results[i].seconds);
    }
  for (std::size_t i = 0; i < problems.size(); ++i) results[i].state = simulations[i]->read();
  return results;
}

double part_of(const std::vector<std::uint8_t>& active) {
  return double(std::ranges::count(active, 1)) / double(active.size());
}

/// Sum of the differences of smoke over that of smoke.
double smoke_apart(const FluidState& got, const FluidState& want) {
  double apart = 0, all = 0;
  for (std::size_t i = 0; i < want.smoke.values.size(); ++i) {
    apart += std::abs(got.smoke.values[i] - want.smoke.values[i]);
    all += want.smoke.values[i];
  }
  return apart / all;
}

ChartData cost_of_smoke(gpu::Context& context) {
  const int cells = 128;
  ChartData data;
  Series by_smoke{.name = "by the smoke's part of the box", .points = {}};
  Series by_tiles{.name = "by the active tiles' part of the box", .points = {}};
  const std::vector<double> parts = {0.1, 0.05, 0.02, 0.005};
  std::vector<FluidProblem> problems = {ball_of_smoke(cells, parts[0])};
  for (const double part : parts) {
    problems.push_back(ball_of_smoke(cells, part));
    problems.back().parameters.sparse = true;
  }
  const std::vector<TimedSteps> timed = three_steps(context, problems);
  const TimedSteps& whole = timed[0];
  const double dense = whole.seconds;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const TimedSteps& sparse = timed[k + 1];
    const double part = parts[k];
    const double cost = sparse.seconds / dense, active = part_of(sparse.state.active);
    const std::string percent = std::to_string(std::lround(1000 * part) / 10.0).substr(0, 4) + " %";
    by_smoke.points.push_back({part, cost, percent});
    by_tiles.points.push_back({active, cost, percent});
    data.settings.emplace_back("smoke in " + percent, "active " + std::to_string(active) +
                                                          ", cost " + std::to_string(cost));
  }
  data.series = {by_smoke,
                 by_tiles,
                 {.name = "cost = part of the box",
                  .points = {{0.003, 0.003, ""}, {0.3, 0.3, ""}},
                  .kind = Series::Kind::theory}};
  data.assertions = {
      {"active part of the box, smoke in 10 %", by_tiles.points[0].x, 0.15},
      {"cost of smoke in 5 % of the box / that of the whole box", by_smoke.points[1].y, 0.2},
      {"smoke that lies elsewhere than in the whole box, three steps on",
       smoke_apart(timed[1].state, whole.state), 0.01}};
  data.settings.emplace_back("grid", "128^3 in a closed box, MacCormack");
  data.settings.emplace_back("dense step", std::to_string(dense) + " s");
  return data;
}

const Registration cost_chart =
    register_chart({.name = "fluid/sparse",
                    .title = "Cost of a step in active tiles, of that of the whole box",
                    .x = {.label = "part of the box"},
                    .y = {.label = "time / dense time"},
                    .produce = cost_of_smoke});

}  // namespace
}  // namespace parity
