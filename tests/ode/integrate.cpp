#include "cpu_reference/ode/integrate.h"

#include "gpu/ode/integrate.h"
#include "tests/chart.h"
#include "tests/ode/problems.h"
#include "tests/stage.h"

/// One stage for each method; their rivalry in one chart, the energy of an oscillator in another,
/// and a map of |R(z)| for each.
namespace parity {
namespace {

using namespace ode_test;

struct About {
  OdeMethod method;
  const char* title;
  const char* source;
};
constexpr About abouts[] = {
    {OdeMethod::explicit_euler, "Explicit Euler steps", "notes 10.1"},
    {OdeMethod::implicit_euler, "Implicit Euler steps by Newton's method", "notes 10.1"},
    {OdeMethod::symplectic_euler, "Symplectic Euler steps", "notes 10.1"},
    {OdeMethod::trapezoid, "Steps of the trapezoid rule by Newton's method", "notes 10.1"},
    {OdeMethod::midpoint, "Midpoint steps (RK2)", "notes 10.1"},
    {OdeMethod::rk4, "Classical Runge-Kutta steps (RK4)", "notes 10.1; Kutta 1901"},
    {OdeMethod::dormand_prince, "Dormand-Prince 5(4) with PI control of the step",
     "notes 10.1; Dormand & Prince 1980; Gustafsson 1991"},
};

/// Against the closed form; the pendulum and van der Pol's oscillator against RK4 with steps of a
/// 64th.
double error_of(const OdeProblem& problem, const OdeResult& result) {
  OdeProblem fine = problem;
  fine.method = OdeMethod::rk4;
  fine.step /= 64;
  fine.steps *= 64;
  const bool closed =
      !problem.instances.empty() && ode_exact(problem.system, problem.instances[0], 0).has_value();
  const OdeResult other = closed ? OdeResult{} : cpu::integrate(fine);
  double worst = 0;
  for (std::size_t i = 0; i < result.states.size(); ++i) {
    const dvec2 want =
        closed ? *ode_exact(problem.system, problem.instances[i], problem.step * problem.steps)
               : other.states[i];
    worst = std::max(worst, glm::length(result.states[i] - want));
  }
  return worst;
}

Registration register_method(const About& about) {
  const OdeMethod method = about.method;
  return register_stage<OdeProblem, OdeResult>({
      .name = std::string("ode/") + name_of(method),
      .title = about.title,
      .source = about.source,
      .rows = method == OdeMethod::symplectic_euler ? std::vector<int>{160}
                                                    : std::vector<int>{158, 159},
      .axes = {{.name = "system", .low = 0, .high = 4, .standard = 1, .whole = true, .each = true},
               {.name = "count",
                .low = 1,
                .high = 1031,
                .standard = 67,
                .logarithmic = true,
                .whole = true},
               {.name = "step",
                .unit = "s",
                .low = 0.005,
                .high = 0.2,
                .standard = 0.05,
                .logarithmic = true},
               {.name = "steps", .low = 0, .high = 200, .standard = 50, .whole = true}},
      .problem = [method](const Setting& setting) { return problem_of(method, setting); },
      .cpu = {{.solve = [](const OdeProblem& p) { return cpu::integrate(p); }}},
      .gpu = {{.name = "batch",
               .solve = [](gpu::Context& context,
                           const OdeProblem& p) { return gpu::integrate(context, p); }}},
      .distance = distance,
      .tolerance = rounding_bound,
      .why =
          "in each step 4 u of the state and 30 u of its change, times the measured condition of "
          "the problem; the adaptive method may be off by its tolerance a step on either side",
      .error = error_of,
      .chart_axes = {"step"},
  });
}

const Registration registrations[] = {register_method(abouts[0]), register_method(abouts[1]),
                                      register_method(abouts[2]), register_method(abouts[3]),
                                      register_method(abouts[4]), register_method(abouts[5]),
                                      register_method(abouts[6])};

/// A swing of the pendulum for 10 s: error against evaluations of f, on the device; the reference
/// is RK4 with 2^16 steps in double.
ChartData work_precision(gpu::Context& context) {
  const OdeInstance instance{{1.0f, 0.0f}, {2.0f, 0.0f}};
  OdeProblem exact{.method = OdeMethod::rk4,
                   .system = OdeSystem::pendulum,
                   .instances = {instance},
                   .step = 10 / 65536.0,
                   .steps = 65536};
  const dvec2 want = cpu::integrate(exact).states[0];
  ChartData data;
  double best_fixed = INFINITY, adaptive = INFINITY;
  for (const About& about : abouts) {
    Series series{name_of(about.method), {}};
    for (int k = 0; k < 9; ++k) {
      OdeProblem problem = exact;
      problem.method = about.method;
      problem.steps = about.method == OdeMethod::dormand_prince ? 40u : 40u << k;
      problem.step = 10.0 / problem.steps;
      problem.tolerance = std::pow(10.0, -1 - 0.6 * k);
      const OdeResult result = gpu::integrate(context, problem);
      const double error = glm::length(result.states[0] - want);
      const double evaluations = result.evaluations[0];
      series.points.push_back({evaluations, error, "steps=" + std::to_string(problem.steps)});
      if (error < 1e-3 && about.method == OdeMethod::dormand_prince)
        adaptive = std::min(adaptive, evaluations);
      if (error < 1e-3 && about.method == OdeMethod::midpoint)
        best_fixed = std::min(best_fixed, evaluations);
    }
    data.series.push_back(series);
  }
  data.assertions.push_back(
      {"evaluations for an error of 1e-3: Dormand-Prince / midpoint", adaptive / best_fixed, 0.5});
  data.settings = {{"problem", "pendulum, 1 rad, 2 rad/s, 10 s"}, {"numbers", "float, sums kept"}};
  return data;
}

const Registration work_chart = register_chart({
    .name = "ode/work_precision",
    .title = "Error of integrators against evaluations of the right-hand side",
    .x = {.label = "evaluations of f"},
    .y = {.label = "error after 10 s", .unit = "rad"},
    .produce = work_precision,
    .pareto = true,
    .fit_slopes = true,
});

/// Energy of an oscillator over 1e5 steps of omega h = 0.1, as largest distance so far from its
/// start.
ChartData energy_drift(gpu::Context& context) {
  ChartData data;
  const OdeInstance instance{{1.0f, 0.0f}, {1.0f, 0.0f}};
  for (const About& about : abouts) {
    if (about.method == OdeMethod::dormand_prince) continue;
    Series series{name_of(about.method), {}};
    double worst = 0;
    for (double steps = 10; steps < 1.2e5; steps *= std::pow(10.0, 0.25)) {
      OdeProblem problem{.method = about.method,
                         .system = OdeSystem::oscillator,
                         .instances = {instance},
                         .step = 0.1,
                         .steps = std::uint32_t(steps)};
      const dvec2 state = gpu::integrate(context, problem).states[0];
      const double energy = ode_energy(problem.system, instance, state);
      worst = std::max(worst, std::abs(energy / 0.5 - 1));
      if (std::isfinite(worst) && worst < 1e30)
        series.points.push_back({double(problem.steps), worst});
    }
    if (about.method == OdeMethod::symplectic_euler)
      data.assertions.push_back({"swing of symplectic Euler over 1e5 steps", worst, 0.055});
    if (about.method == OdeMethod::trapezoid)
      data.assertions.push_back({"drift of the trapezoid over 1e5 steps", worst, 1e-3});
    data.series.push_back(series);
  }
  data.settings = {{"omega h", "0.1"}};
  return data;
}

const Registration drift_chart = register_chart({
    .name = "ode/energy_drift",
    .title = "Energy of an oscillator: how far it has been from its start",
    .x = {.label = "steps"},
    .y = {.label = "|E / E0 - 1|"},
    .produce = energy_drift,
});

Registration register_stability(const About& about) {
  const OdeMethod method = about.method;
  return register_map({
      .name = std::string("ode/stability_") + name_of(method),
      .title = std::string("|R(z)| of ") + name_of(method) + ", by one step on the device",
      .x = {.name = "Re z", .low = -4, .high = 2, .standard = 0},
      .y = {.name = "Im z", .low = 0, .high = 4, .standard = 0},
      .value_label = "|R|",
      .columns = 25,
      .rows = 17,
      .value =
          [method](gpu::Context& context, double x, double y) {
            const OdeProblem problem{.method = method,
                                     .system = OdeSystem::linear,
                                     .instances = {{{1, 0}, {float(x), float(y)}}},
                                     .step = 1,
                                     .steps = 1};
            return glm::length(gpu::integrate(context, problem).states[0]);
          },
      .theory = {{"|R(z)| = 1", [method](double x) { return stability_border(method, x); }}},
  });
}

const Registration maps[] = {register_stability(abouts[0]), register_stability(abouts[1]),
                             register_stability(abouts[3]), register_stability(abouts[4]),
                             register_stability(abouts[5])};

/// Energy after 1000 steps of an oscillator over that at the start; omega h < 2 is the border
/// whatever omega.
const Registration symplectic_map = register_map({
    .name = "ode/stability_symplectic_euler",
    .title = "Energy of an oscillator after 1000 symplectic Euler steps",
    .x = {.name = "omega",
          .unit = "rad/s",
          .low = 0.5,
          .high = 20,
          .standard = 1,
          .logarithmic = true},
    .y = {.name = "h", .unit = "s", .low = 0.05, .high = 5, .standard = 0.1, .logarithmic = true},
    .value_label = "E / E0",
    .border = 1e6,
    .columns = 20,
    .rows = 16,
    .value =
        [](gpu::Context& context, double omega, double h) {
          const OdeProblem problem{.method = OdeMethod::symplectic_euler,
                                   .system = OdeSystem::oscillator,
                                   .instances = {{{1, 0}, {float(omega), 0}}},
                                   .step = h,
                                   .steps = 1000};
          const dvec2 state = gpu::integrate(context, problem).states[0];
          const double energy =
              ode_energy(problem.system, problem.instances[0], state) / (omega * omega / 2);
          return std::isfinite(energy) ? std::min(energy, 1e30) : 1e30;
        },
    .theory = {{"omega h = 2", [](double omega) { return 2 / omega; }}},
});

}  // namespace
}  // namespace parity
