#include <chrono>
#include <functional>
#include <map>

#include "cpu_reference/sph/step.h"
#include "gpu/sph/constants.h"
#include "gpu/sph/step.h"
#include "shaders.h"
#include "tests/chart.h"
#include "tests/sph/problems.h"

/// Charts of particle fluids beyond their stages: accuracy, stability and cost of whole runs.
namespace parity {
namespace {

ChartData hydrostatic(gpu::Context& context) {
  SphProblem problem = sph_hydrostatic_column(2, 0.2, 1, 40);
  problem.parameters.artificial_viscosity = 2;
  const sph_test::Column column = sph_test::settle_column(context, problem);
  Series measured{"layers of particles", {}};
  Series theory{"weight above", {}, Series::Kind::theory};
  for (std::size_t k = 0; k < column.depths.size(); ++k) {
    measured.points.push_back({column.depths[k], column.pressures[k]});
    theory.points.push_back({column.depths[k], 1000 * 9.81 * column.depths[k]});
  }
  return {
      .series = {measured, theory},
      .assertions = {{"RMS error of the layers, in pressures at the floor", column.error, 0.01}},
      .settings = {{"column", "1 m, 40 particles high, 2D, Tait"}}};
}

const Registration hydrostatic_chart = register_chart({
    .name = "sph/hydrostatic",
    .title = "Pressure in a column of particles at rest",
    .x = {.label = "depth", .unit = "m", .logarithmic = false},
    .y = {.label = "pressure", .unit = "Pa", .logarithmic = false},
    .produce = hydrostatic,
});

/// Average compression over the thirtieths of a dam break against the seconds that a simulated
/// second takes, and the largest compression of a particle at their ends.
struct DamBreak {
  Point point;
  double largest = 0;
};

DamBreak run_dam_break(gpu::Context& context, const SphProblem& problem, const std::string& label) {
  gpu::SphStep step(context, problem);
  const auto start = std::chrono::steady_clock::now();
  double error = 0, largest = 0;
  constexpr int samples = 30;
  for (int k = 1; k <= samples; ++k) {
    gpu::advance(context, step, problem.duration * k / samples, 100000);
    const SphDensityError now = density_error(problem.parameters, step.densities().read());
    error += now.average / samples;
    largest = std::max(largest, now.largest);
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  return {{seconds.count() / problem.duration, error, label}, largest};
}

ChartData methods(gpu::Context& context) {
  Series weak{"weakly compressible, Tait", {}};
  Series linear{"weakly compressible, linear", {}};
  Series incompressible{"incompressible", {}};
  const SphProblem dam = sph_dam_break(2, 0.1, 20);
  for (const double factor : {0.5, 1.0, 2.0}) {
    SphProblem problem = dam;
    problem.parameters.sound_speed *= factor;
    const std::string label = "c=" + short_number(10 * factor) + " v";
    weak.points.push_back(run_dam_break(context, problem, label).point);
    problem.parameters.equation_of_state = SphEquationOfState::linear;
    linear.points.push_back(run_dam_break(context, problem, label).point);
  }
  DamBreak best;
  for (const double tolerance : {2e-3, 5e-4, 1e-4}) {
    SphProblem problem = dam;
    problem.parameters.method = SphMethod::divergence_free;
    problem.parameters.density_error = tolerance;
    problem.parameters.courant = 0.25;
    problem.parameters.max_step = 2e-3;
    problem.parameters.max_iterations = 40;
    best = run_dam_break(context, problem, "eta=" + short_number(tolerance));
    incompressible.points.push_back(best.point);
  }
  return {.series = {weak, linear, incompressible},
          .assertions = {{"average density error of the incompressible method", best.point.y, 1e-3},
                         {"largest density error of its particles", best.largest, 1e-2}},
          .settings = {{"scene", "dam break, 2D, 20 particles wide"}}};
}

const Registration methods_chart = register_chart({
    .name = "sph/methods",
    .title = "Density error of particle methods against their cost",
    .x = {.label = "time per simulated second", .unit = "s"},
    .y = {.label = "average compression"},
    .produce = methods,
    .pareto = true,
});

/// A cube of about `count` particles at rest in a corner of its tank.
SphProblem cube_of(double count) {
  return sph_dam_break(3, 1, int(std::lround(std::cbrt(count / 2))));
}

/// Device seconds by pass, means of some steps.
std::map<std::string, double> time_step(gpu::Context& context, gpu::SphStep& step, int repeats) {
  std::map<std::string, double> sums;
  for (int k = 0; k < repeats; ++k) {
    const gpu::Timing timing =
        context.run([&](gpu::Commands& commands) { step.record(commands, 1e9); });
    for (const auto& [name, seconds] : timing.passes) sums[name] += seconds / repeats;
    sums["whole"] += timing.seconds / repeats;
  }
  return sums;
}

ChartData scaling(gpu::Context& context) {
  Series whole{"whole step", {}}, neighbours{"neighbours", {}}, forces{"forces", {}};
  double bytes = 0;
  for (const double count : {1e4, 3e4, 1e5, 3e5, 1e6}) {
    const SphProblem problem = cube_of(count);
    const double n = double(problem.initial.positions.size());
    const std::uint64_t before = context.memory_bytes();
    gpu::SphStep step(context, problem);
    bytes = double(context.memory_bytes() - before) / n * 1e6;
    // As long for each count, so that what else the machine does meets all alike.
    time_step(context, step, 1);
    const auto seconds = time_step(context, step, std::max(2, int(2e6 / n)));
    whole.points.push_back({n, seconds.at("whole")});
    neighbours.points.push_back({n, seconds.at("neighbours")});
    forces.points.push_back({n, seconds.at("forces")});
  }
  const Point &first = whole.points.front(), &last = whole.points.back();
  const double exponent = std::log(last.y / first.y) / std::log(last.x / first.x);
  return {.series = {whole, neighbours, forces},
          .assertions = {{"exponent of the cost of a step", exponent, 1.1},
                         {"memory of a million particles, GiB", bytes / 0x1p30, 1}}};
}

const Registration scaling_chart = register_chart({
    .name = "sph/scaling",
    .title = "Cost of a weakly compressible step against particles",
    .x = {.label = "particles"},
    .y = {.label = "device time per step", .unit = "s"},
    .produce = scaling,
    .fit_slopes = true,
});

/// Cells of one support, x fastest, and the particles sorted by them.
struct NativeCells {
  ivec3 cells{0};
  float support = 0;
  std::vector<vec4> sorted;
  std::vector<std::uint32_t> starts;
  ivec3 cell_of(const vec4& p) const {
    return glm::clamp(ivec3(vec3(p) / support) + 1, ivec3(0), cells - 1);
  }
  int index_of(const ivec3& c) const { return (c.z * cells.y + c.y) * cells.x + c.x; }
};

NativeCells sort_natively(const SphProblem& problem) {
  NativeCells native;
  native.support = float(problem.parameters.support);
  native.cells = ivec3(vec3(problem.domain.high) / native.support) + 3;
  for (const vec3& p : problem.initial.positions) native.sorted.emplace_back(p, 0.0f);
  const auto key = [&](const vec4& p) { return native.index_of(native.cell_of(p)); };
  std::ranges::stable_sort(native.sorted, {}, key);
  native.starts.assign(std::size_t(native.cells.x) * native.cells.y * native.cells.z + 1, 0);
  for (const vec4& p : native.sorted) ++native.starts[std::size_t(key(p)) + 1];
  for (std::size_t c = 1; c < native.starts.size(); ++c) native.starts[c] += native.starts[c - 1];
  return native;
}

/// Sum of the cubic spline's profile over the neighbours of each particle, on all threads; counts
/// the candidates.
std::vector<float> sum_natively(const NativeCells& native, double& candidates) {
  const float reach = native.support * native.support;
  std::vector<float> sums(native.sorted.size());
  std::int64_t looked = 0;
#pragma omp parallel for schedule(static) reduction(+ : looked)
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const vec4 p = native.sorted[i];
    const ivec3 cell = native.cell_of(p);
    float sum = 0;
    for (int z = std::max(cell.z - 1, 0); z <= std::min(cell.z + 1, native.cells.z - 1); ++z)
      for (int y = std::max(cell.y - 1, 0); y <= std::min(cell.y + 1, native.cells.y - 1); ++y) {
        const int first = native.index_of({std::max(cell.x - 1, 0), y, z});
        const int last = native.index_of({std::min(cell.x + 1, native.cells.x - 1), y, z});
        const std::uint32_t end = native.starts[std::size_t(last) + 1];
        for (std::uint32_t j = native.starts[std::size_t(first)]; j < end; ++j) {
          const vec3 d = vec3(p) - vec3(native.sorted[j]);
          const float r2 = glm::dot(d, d);
          ++looked;
          if (r2 >= reach) continue;
          const float q = std::sqrt(r2) / native.support;
          const float t = 1 - q;
          sum += q < 0.5f ? 1 - 6 * q * q * t : 2 * t * t * t;
        }
      }
    sums[i] = sum;
  }
  candidates = double(looked) / double(sums.size());
  return sums;
}

double wall_seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  return seconds.count();
}

/// Measures the device seconds that one access to memory takes: of a permutation's gather, which
/// reads an index and a vec4 and writes a vec4 for each particle.
class AccessProbe {
 public:
  AccessProbe(gpu::Context& context, const SphProblem& problem)
      : count_(std::uint32_t(problem.initial.positions.size())),
        neighbours_(context, problem, gpu::sph_constants(problem)),
        positions_(context, gpu::with_zero(problem.initial.positions)),
        target_(context, count_),
        gather_(context, gpu::shaders::sph_gather_comp) {
    context.run([&](gpu::Commands& commands) { neighbours_.record(commands, positions_); });
  }

  double seconds_an_access(gpu::Context& context) {
    constexpr int repeats = 20;
    const gpu::Timing timing = context.run([&](gpu::Commands& commands) {
      for (int r = 0; r < repeats; ++r)
        commands.dispatch(
            gather_, {count_},
            {.ids = neighbours_.cells().ids(), .from = positions_, .to = target_, .count = count_});
    });
    return timing.seconds / repeats / (3.0 * count_);
  }

 private:
  std::uint32_t count_;
  gpu::Neighbours neighbours_;
  gpu::Buffer<vec4> positions_, target_;
  gpu::Kernel<GatherArgs> gather_;
};

double middle(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// 100,000 particles: the passes on the device beside a native density pass over the same cells,
/// and the whole step beside the time that its accesses to memory take. All take turns, so that
/// what else the machine does meets all alike; medians of times and of ratios within a turn.
ChartData cost_of_a_step(gpu::Context& context) {
  constexpr int turns = 15;
  const SphProblem problem = cube_of(1e5);
  const double n = double(problem.initial.positions.size());
  gpu::SphStep step(context, problem);
  AccessProbe probe(context, problem);
  const NativeCells native = sort_natively(problem);
  double candidates = 0, neighbours = 0;
  for (const auto& list : cpu::sph_neighbours(problem).fluid) neighbours += double(list.size()) / n;
  sum_natively(native, candidates);
  // Neighbours: candidates read, lists written. Forces: index, place and motion of each neighbour.
  // Sort: four passes that read a key twice and a value and write both. A score of others.
  const double accesses = n * (candidates + neighbours * (1 + 3) + 4 * 5 + 20);
  std::map<std::string, std::vector<double>> seen;
  for (int turn = 0; turn < turns; ++turn) {
    const auto seconds = time_step(context, step, 1);
    for (const auto& [name, value] : seconds) seen[name].push_back(value);
    const double alone = wall_seconds([&] { sum_natively(native, candidates); });
    const double limit = accesses * probe.seconds_an_access(context);
    seen["native"].push_back(alone);
    seen["limit"].push_back(limit);
    seen["density / native"].push_back((seconds.at("neighbours") + seconds.at("density")) / alone);
    seen["whole / limit"].push_back(seconds.at("whole") / limit);
  }
  Series device{"device", {}}, beside{"native density, traffic", {}};
  const char* passes[] = {"sort", "neighbours", "density", "forces", "whole"};
  for (int k = 0; k < 5; ++k)
    device.points.push_back({k + 1.0, middle(seen.at(passes[k])), passes[k]});
  beside.points = {{2, middle(seen.at("native")), "native density"},
                   {5, middle(seen.at("limit")), "traffic of the step"}};
  return {.series = {device, beside},
          .assertions = {{"neighbours and density on the device / native density",
                          middle(seen.at("density / native")), 2},
                         {"whole step / its traffic", middle(seen.at("whole / limit")), 3}},
          .settings = {{"particles", short_number(n)},
                       {"candidates a particle", short_number(std::round(candidates))},
                       {"neighbours a particle", short_number(std::round(neighbours))}}};
}

const Registration cost_chart = register_chart({
    .name = "sph/step_cost",
    .title = "Where a step of 100,000 particles spends its time",
    .x = {.label = "pass: sort, neighbours, density, forces, whole", .logarithmic = false},
    .y = {.label = "time", .unit = "s"},
    .produce = cost_of_a_step,
});

constexpr int map_steps = 150;

/// Growth of the speed of a box of particles over steps and one parameter.
Map stability_map(const char* name, const char* title, Axis x,
                  std::function<SphProblem(double)> box, std::vector<TheoryLine> theory) {
  return {.name = name,
          .title = title,
          .x = std::move(x),
          .y = {.name = "step",
                .unit = "s",
                .low = 1e-4,
                .high = 1,
                .standard = 1e-2,
                .logarithmic = true},
          .value_label = "growth of speed",
          .border = 100,
          .columns = 14,
          .rows = 14,
          .value =
              [box = std::move(box)](gpu::Context& context, double value, double step) {
                SphProblem problem = box(value);
                problem.parameters.fixed_step = step;
                return sph_test::speed_growth(context, problem, map_steps);
              },
          .theory = std::move(theory)};
}

const Axis viscosity_axis{.name = "viscosity",
                          .unit = "m^2/s",
                          .low = 1e-3,
                          .high = 10,
                          .standard = 0.1,
                          .logarithmic = true};

SphProblem sounding_box(double sound) { return sph_test::closed_box(8, sound, 0.005 * sound); }

SphProblem viscous_box(double viscosity) { return sph_test::closed_box(8, 10, viscosity); }

SphProblem implicit_box(double viscosity) {
  SphProblem problem = viscous_box(viscosity);
  problem.parameters.implicit_viscosity = true;
  problem.parameters.max_iterations = 30;
  return problem;
}

/// The largest stable step of a box, by theory.
std::function<double(double)> stable_step_of(SphProblem (*box)(double)) {
  return [box](double x) { return cpu::sph_stable_step(box(x).parameters); };
}

const Registration sound_map = register_map(stability_map(
    "sph/stability_sound", "Speed after 150 steps of a box of particles over that at the start",
    {.name = "sound speed",
     .unit = "m/s",
     .low = 1,
     .high = 100,
     .standard = 10,
     .logarithmic = true},
    sounding_box, {{"(omega dt)^2 + 2 g dt = 4", stable_step_of(sounding_box)}}));

const Registration viscosity_map = register_map(stability_map(
    "sph/stability_viscosity",
    "Speed after 150 steps of a viscous box of particles over that at the start", viscosity_axis,
    viscous_box, {{"(omega dt)^2 + 2 g dt = 4", stable_step_of(viscous_box)}}));

const Registration implicit_map = register_map(stability_map(
    "sph/stability_implicit",
    "The same box with implicit viscosity: speed after 150 steps over that at the start",
    viscosity_axis, implicit_box,
    {{"implicit: (omega dt)^2 = 4 + 2 g dt", stable_step_of(implicit_box)},
     {"explicit: (omega dt)^2 + 2 g dt = 4", stable_step_of(viscous_box)}}));

}  // namespace
}  // namespace parity
