#include "tests/stage.h"

#include <fnmatch.h>

#include <algorithm>
#include <chrono>

namespace parity {
namespace {

/// Kept sorted by name.
std::vector<Stage>& registry() {
  static std::vector<Stage> stages;
  return stages;
}

void require_complete(const Stage& stage) {
  const bool complete = !stage.name.empty() && !stage.title.empty() && !stage.source.empty() &&
                        !stage.why.empty() && stage.problem && stage.distance &&
                        !stage.methods.empty() && stage.methods.front().side == Side::cpu;
  if (!complete)
    throw std::logic_error("stage '" + stage.name +
                           "': needs name, title, source, why, problem, distance and a reference");
  for (const Axis& axis : stage.axes) {
    const bool ordered = axis.low <= axis.standard && axis.standard <= axis.high;
    if (!ordered || (axis.logarithmic && axis.low <= 0))
      throw std::logic_error("stage '" + stage.name + "': axis " + axis.name +
                             " needs low <= standard <= high, low > 0 if logarithmic");
  }
}

MethodTrial run_method(const Stage& stage, const std::any& problem, std::size_t index,
                       gpu::Context* context, std::vector<std::optional<Attempt>>& attempts) {
  const Method& method = stage.methods[index];
  MethodTrial trial{.method = method.label(), .side = method.side};
  try {
    attempts[index] = stage.attempt(problem, index, context);
  } catch (const Unsupported& unsupported) {
    trial.skipped = unsupported.what();
    return trial;
  }
  const Attempt& attempt = *attempts[index];
  trial.seconds = attempt.seconds;
  if (stage.error) trial.error = stage.error(problem, attempt);
  if (stage.growth) trial.growth = stage.growth(problem, attempt);
  if (method.judge && attempts[*method.judge]) {
    trial.judge = stage.methods[*method.judge].label();
    trial.distance = stage.distance(problem, attempt, *attempts[*method.judge]);
  }
  return trial;
}

bool matches_one(const std::string& name, const std::string& pattern) {
  return pattern == "all" || fnmatch(pattern.c_str(), name.c_str(), 0) == 0 ||
         fnmatch((pattern + "/*").c_str(), name.c_str(), 0) == 0;
}

}  // namespace

bool Trial::passed() const {
  return std::ranges::all_of(methods, [this](const MethodTrial& method) {
    return !method.distance || *method.distance <= tolerance;
  });
}

Trial run_stage(const Stage& stage, const Setting& setting, gpu::Context* context,
                const std::any& problem) {
  Trial trial;
  trial.setting = setting;
  trial.tolerance = stage.tolerance(problem);
  trial.attempts.resize(stage.methods.size());
  for (std::size_t i = 0; i < stage.methods.size(); ++i)
    trial.methods.push_back(run_method(stage, problem, i, context, trial.attempts));
  return trial;
}

std::span<const Stage> all_stages() { return registry(); }

bool name_matches(const std::string& name, std::span<const std::string> patterns) {
  return patterns.empty() || std::ranges::any_of(patterns, [&](const std::string& pattern) {
           return matches_one(name, pattern);
         });
}

Registration register_stage(Stage stage) {
  require_complete(stage);
  const auto place = std::ranges::lower_bound(registry(), stage.name, {}, &Stage::name);
  if (place != registry().end() && place->name == stage.name)
    throw std::logic_error("stage '" + stage.name + "' is registered twice");
  registry().insert(place, std::move(stage));
  return {};
}

namespace detail {

double incomparable(std::span<const double> got, std::span<const double> want) {
  if (got.size() != want.size()) return std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < got.size(); ++i)
    if (std::isnan(got[i]) != std::isnan(want[i])) return std::numeric_limits<double>::infinity();
  return 0;
}

double wall_seconds() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

std::vector<Method> link_judges(std::vector<Method> methods, const std::vector<bool>& must_agree) {
  for (std::size_t i = 1; i < methods.size(); ++i) {
    if (!must_agree[i]) continue;
    std::size_t judge = 0;
    for (std::size_t k = 0; k < methods.size(); ++k)
      if (methods[i].side == Side::gpu && methods[k].side == Side::cpu &&
          methods[k].name == methods[i].name)
        judge = k;
    methods[i].judge = judge;
  }
  return methods;
}

}  // namespace detail
}  // namespace parity
