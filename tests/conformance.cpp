#include "tests/conformance.h"

#include <algorithm>

namespace parity {
namespace {

std::string join(const std::string& text, const std::string& more) {
  if (text.empty() || more.empty()) return text + more;
  return text + "; " + more;
}

/// What is wrong with a trial; empty: nothing.
std::string complaint(const Stage& stage, const Trial& trial) {
  std::string text;
  for (const MethodTrial& method : trial.methods)
    if (method.distance && !(*method.distance <= trial.tolerance))
      text = join(text, method.method + " is " + short_number(*method.distance) + " from " +
                            method.judge + ", tolerance " + short_number(trial.tolerance) + " (" +
                            stage.why + ")");
  return text;
}

void judge(const Stage& stage, CheckResult& result) {
  using enum CheckResult::Outcome;
  result.message = join(result.message, complaint(stage, result.trial));
  if (!result.message.empty()) {
    result.outcome = failed;
    return;
  }
  const auto compared = [](const MethodTrial& method) { return method.distance.has_value(); };
  if (std::ranges::any_of(result.trial.methods, compared)) return;
  result.outcome = skipped;
  for (const MethodTrial& method : result.trial.methods)
    if (!method.skipped.empty())
      result.message = join(result.message, method.method + ": " + method.skipped);
  if (result.message.empty()) result.message = "one method only: nothing to compare";
}

}  // namespace

std::vector<Check> checks_of(std::span<const Stage> stages, std::span<const std::string> patterns) {
  std::vector<Check> checks;
  for (const Stage& stage : stages)
    for (NamedSetting& named : conformance_settings(stage.axes)) {
      Check check{&stage, std::move(named)};
      if (name_matches(check.name(), patterns)) checks.push_back(std::move(check));
    }
  return checks;
}

CheckResult run_check(const Check& check, gpu::Context* context,
                      std::optional<std::span<const double>> problem_numbers) {
  const Stage& stage = *check.stage;
  CheckResult result;
  const double start = detail::wall_seconds();
  try {
    result.problem = make_problem(stage, check.named.setting, context);
    if (problem_numbers) stage.set_problem_numbers(result.problem, *problem_numbers);
  } catch (const std::exception& error) {
    if (problem_numbers) throw;
    result.message = std::string("making the problem: ") + error.what();
  }
  try {
    if (result.message.empty())
      result.trial = run_stage(stage, check.named.setting, context, result.problem);
  } catch (const gpu::Error& error) {
    if (error.kind() == gpu::ErrorKind::device_lost) throw;
    result.message = error.what();
  } catch (const std::exception& error) {
    result.message = error.what();
  }
  if (context != nullptr)
    for (const std::string& message : context->take_validation_messages())
      result.message = join(result.message, "validation: " + message);
  result.seconds = detail::wall_seconds() - start;
  judge(stage, result);
  return result;
}

}  // namespace parity
