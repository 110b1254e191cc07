#include "tools/stage_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "tests/statistics.h"

namespace parity::tools {
namespace {

constexpr int steps = 8;
constexpr int most_repetitions = 15;
constexpr int least_repetitions = 3;
constexpr double enough_seconds = 0.03;  ///< of work a point
constexpr double most_seconds = 3.0;     ///< a step; the axis ends there

struct Measurement {
  std::optional<double> error;
  std::vector<double> seconds;
};

/// All methods on one problem, by turns; none for a method that does not cover it.
std::vector<std::optional<Measurement>> measure(const Stage& stage, const std::any& problem,
                                                gpu::Context& context) {
  std::vector<std::optional<Measurement>> measurements(stage.methods.size());
  double spent = 0, least_spent = 0;
  for (int repetition = 0; repetition <= most_repetitions; ++repetition) {
    least_spent = enough_seconds;
    for (std::size_t i = 0; i < stage.methods.size(); ++i) {
      if (repetition > 0 && !measurements[i]) continue;
      try {
        const double start = detail::wall_seconds();
        const Attempt attempt = stage.attempt(problem, i, &context);
        spent += detail::wall_seconds() - start;
        if (repetition == 0) {
          measurements[i].emplace();
          if (stage.error) measurements[i]->error = stage.error(problem, attempt);
          continue;
        }
        measurements[i]->seconds.push_back(attempt.seconds);
        double method_spent = 0;
        for (double seconds : measurements[i]->seconds) method_spent += seconds;
        least_spent = std::min(least_spent, method_spent);
      } catch (const Unsupported&) {
        measurements[i].reset();
      }
    }
    if (spent > most_seconds && repetition > 0) break;
    if (repetition >= least_repetitions && least_spent >= enough_seconds) break;
  }
  return measurements;
}

void add_points(const Stage& stage, const Axis& axis, double value,
                const std::vector<std::optional<Measurement>>& measurements, ChartData& data) {
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    if (!measurements[i] || measurements[i]->seconds.empty()) continue;
    const double time_ms = 1000 * median(measurements[i]->seconds);
    Point point{.x = value, .y = time_ms, .label = fmt::format("{}={:.3g}", axis.name, value)};
    if (stage.error) {
      point.x = time_ms;
      point.y = measurements[i]->error.value_or(0);
    }
    data.series[i].points.push_back(point);
  }
}

ChartData produce(const Stage& stage, const Axis& axis, gpu::Context& context) {
  ChartData data;
  for (const Method& method : stage.methods)
    data.series.push_back({.name = method.label(), .points = {}});
  Setting setting(stage.axes);
  for (double value : steps_along(axis, steps)) {
    setting.set(axis.name, value);
    const double start = detail::wall_seconds();
    const std::any problem = make_problem(stage, setting, &context);
    add_points(stage, axis, value, measure(stage, problem, context), data);
    if (detail::wall_seconds() - start > 2 * most_seconds) break;
  }
  std::erase_if(data.series, [](const Series& series) { return series.points.empty(); });
  for (const auto& [name, value] : setting.values())
    if (name != axis.name) data.settings.emplace_back(name, short_number(value));
  data.settings.emplace_back(axis.name, short_number(axis.low) + " to " + short_number(axis.high));
  data.settings.emplace_back("seed", std::to_string(setting.seed));
  data.settings.emplace_back("timed",
                             context.info().timestamps
                                 ? "the device by its own clock, without uploads and reading "
                                   "back; the host by the wall"
                                 : "by the wall");
  return data;
}

Chart chart_along(const Stage& stage, const Axis& axis) {
  Chart chart{
      .name = stage.name + "-" + axis.name,
      .title = stage.title,
      .produce = [&stage, axis](gpu::Context& context) { return produce(stage, axis, context); },
      .fit_slopes = true};
  const ChartAxis time{.label = "time", .unit = "ms"};
  if (stage.error) {
    chart.x = time;
    chart.y = {.label = "error", .unit = stage.error_unit};
    chart.pareto = true;
  } else {
    chart.x = {.label = axis.name, .unit = axis.unit, .logarithmic = axis.low > 0};
    chart.y = time;
  }
  return chart;
}

}  // namespace

std::vector<Chart> charts_of(const Stage& stage) {
  std::vector<std::string> names = stage.chart_axes;
  if (names.empty() && !stage.axes.empty()) names.push_back(stage.axes.front().name);
  std::vector<Chart> charts;
  for (const std::string& name : names) {
    const auto axis = std::ranges::find(stage.axes, name, &Axis::name);
    if (axis == stage.axes.end())
      throw std::invalid_argument("stage " + stage.name + ": no axis " + name + " to chart along");
    charts.push_back(chart_along(stage, *axis));
  }
  return charts;
}

}  // namespace parity::tools
