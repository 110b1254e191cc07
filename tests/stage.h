#pragma once

#include <any>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "gpu/core/context.h"
#include "tests/numbers.h"
#include "tests/setting.h"

/// A stage is one problem solved by sides that share nothing but data. Its record is written as
/// StageRecord and registered by its own file; conformance test, chart, map and catalogue follow.
namespace parity {

/// Thrown by a method for a problem that this device or method does not cover; the method counts as
/// skipped, not as failed.
class Unsupported : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An answer, with the seconds that it took where the method knows better than the clocks around
/// it: the device's own for what a Context ran, the wall's for the host. A plain answer converts.
template <typename Answer>
struct Measured {
  Measured(Answer value) : answer(std::move(value)) {}
  Measured(Answer value, double own_seconds) : answer(std::move(value)), seconds(own_seconds) {}
  Answer answer;
  std::optional<double> seconds;
};

/// One way to solve the problem on the host. The first of a record is the reference. Rivals are
/// drawn together but not compared, unless one must agree with the reference.
template <typename Problem, typename Answer>
struct CpuMethod {
  std::string name = "reference";
  std::function<Measured<Answer>(const Problem&)> solve = {};
  bool must_agree = false;
};

/// One way to solve it on the device. Compared with the host's method of the same name, else with
/// the reference.
template <typename Problem, typename Answer>
struct GpuMethod {
  std::string name = "compute";
  std::function<Measured<Answer>(gpu::Context&, const Problem&)> solve = {};
};

/// distance(got, want) or distance(problem, got, want), 0 for equal. Answers with different counts
/// of numbers, or with NaN on one side only, are infinitely far apart whatever it says.
template <typename Problem, typename Answer>
struct Distance {
  Distance() = default;
  template <std::invocable<const Answer&, const Answer&> F>
  Distance(F f)
      : of([f](const Problem&, const Answer& got, const Answer& want) { return f(got, want); }) {}
  template <std::invocable<const Problem&, const Answer&, const Answer&> F>
  Distance(F f) : of(std::move(f)) {}
  std::function<double(const Problem&, const Answer& got, const Answer& want)> of;
};

/// Makes a problem from a setting, or from a setting and the device that is to solve it (a
/// DeviceInfo of zeros without one), where the reference has to know how a device rounds.
template <typename Problem>
struct MakeProblem {
  MakeProblem() = default;
  template <std::invocable<const Setting&> F>
  MakeProblem(F f)
      : of([f](const Setting& setting, const gpu::DeviceInfo&) { return f(setting); }) {}
  template <std::invocable<const Setting&, const gpu::DeviceInfo&> F>
  MakeProblem(F f) : of(std::move(f)) {}
  std::function<Problem(const Setting&, const gpu::DeviceInfo&)> of;
};

/// The largest distance that is no error: a number, or a function of the problem.
template <typename Problem>
struct Tolerance {
  Tolerance(double bound) : of([bound](const Problem&) { return bound; }) {}
  template <std::invocable<const Problem&> F>
  Tolerance(F f) : of(std::move(f)) {}
  std::function<double(const Problem&)> of;
};

/// A line that theory draws on a map.
struct TheoryLine {
  std::string label;
  std::function<double(double x)> y;
};

/// Growth over two axes of a stage.
struct StageMap {
  std::string x_axis;
  std::string y_axis;
  std::vector<TheoryLine> theory = {};
};

/// What the author of a stage writes down.
template <typename Problem, typename Answer>
struct StageRecord {
  std::string name;            ///< "raster/edge_coverage"
  std::string title;           ///< one line for people
  std::string source;          ///< "notes 1.4; Pineda 1988"
  std::vector<int> rows = {};  ///< of the checklist
  std::vector<Axis> axes = {};
  MakeProblem<Problem> problem;  ///< same setting and seed, same problem
  std::vector<CpuMethod<Problem, Answer>> cpu;
  std::vector<GpuMethod<Problem, Answer>> gpu = {};
  Distance<Problem, Answer> distance;
  Tolerance<Problem> tolerance;
  std::string why;  ///< the reason for the tolerance
  std::function<double(const Problem&, const Answer&)> error = {};  ///< against the exact answer
  std::string error_unit = "1";
  std::function<double(const Problem&, const Answer&)> growth = {};  ///< > 1: unstable or failed
  std::vector<std::string> chart_axes = {};  ///< error against seconds along each
  std::vector<StageMap> maps = {};
};

enum class Side { cpu, gpu };

/// A method of a stage, as others see it.
struct Method {
  std::string name;
  Side side = Side::cpu;
  std::optional<std::size_t> judge = {};  ///< index of the method that it is compared with
  std::string label() const { return (side == Side::cpu ? "cpu " : "gpu ") + name; }
};

/// One method's answer to one problem.
struct Attempt {
  std::any answer;
  double seconds = 0;  ///< of the device's clock without uploads and reading back, or of the wall's
};

/// A record without its types. Problems travel as std::any.
struct Stage {
  std::string name, title, source, why, error_unit;
  std::vector<int> rows;
  std::vector<Axis> axes;
  std::vector<Method> methods;
  std::vector<std::string> chart_axes;
  std::vector<StageMap> maps;

  std::function<std::any(const Setting&, const gpu::DeviceInfo&)> problem;
  std::function<double(const std::any& problem)> tolerance;
  /// @throws Unsupported  the method does not cover this problem; gpu::Error for the device's
  /// faults.
  std::function<Attempt(const std::any& problem, std::size_t method, gpu::Context*)> attempt;
  std::function<double(const std::any& problem, const Attempt& got, const Attempt& want)> distance;
  std::function<double(const std::any& problem, const Attempt&)> error;  ///< empty: no exact answer
  std::function<double(const std::any& problem, const Attempt&)> growth;  ///< empty: cannot fail

  std::function<std::vector<double>(const std::any& problem)> problem_numbers;
  std::function<void(std::any& problem, std::span<const double>)> set_problem_numbers;
  std::function<std::vector<double>(const Attempt&)> answer_numbers;
  std::function<void(Attempt&, std::span<const double>)> set_answer_numbers;
};

/// What came of one method.
struct MethodTrial {
  std::string method = {};  ///< "gpu compute"
  Side side = Side::cpu;
  std::string judge = {};    ///< the method that it was compared with; empty: none
  std::string skipped = {};  ///< why; empty: it ran
  double seconds = 0;
  std::optional<double> distance = {};
  std::optional<double> error = {};
  std::optional<double> growth = {};
};

/// A stage run once at one setting by all its methods.
struct Trial {
  Setting setting;
  double tolerance = 0;
  std::vector<MethodTrial> methods;
  std::vector<std::optional<Attempt>> attempts;  ///< one a method; none: skipped
  /// Everything that was compared is within the tolerance; NaN never is.
  bool passed() const;
};

/// The problem of a setting for that device; null: for none.
inline std::any make_problem(const Stage& stage, const Setting& setting,
                             const gpu::Context* context) {
  return stage.problem(setting, context == nullptr ? gpu::DeviceInfo{} : context->info());
}

/// Runs all methods of a stage.
///
/// @param context  the device; null: its methods are skipped.
/// @throws what a method throws, except Unsupported.
Trial run_stage(const Stage& stage, const Setting& setting, gpu::Context* context,
                const std::any& problem);
inline Trial run_stage(const Stage& stage, const Setting& setting, gpu::Context* context) {
  return run_stage(stage, setting, context, make_problem(stage, setting, context));
}

/// Every stage of the program, sorted by name.
std::span<const Stage> all_stages();

/// Names match globs of * and ?; a pattern also matches all below it, as a folder does. No pattern
/// matches everything, and so does "all".
bool name_matches(const std::string& name, std::span<const std::string> patterns);

struct [[maybe_unused]] Registration {
  Registration() {}
};

/// @throws std::logic_error  a stage of that name is there already, or the record is incomplete.
Registration register_stage(Stage stage);

namespace detail {

/// Infinity if the answers cannot be compared: counts differ, or NaN stands on one side only.
double incomparable(std::span<const double> got, std::span<const double> want);
double wall_seconds();
std::vector<Method> link_judges(std::vector<Method> methods, const std::vector<bool>& must_agree);

/// Seconds of what the device ran, or of the wall clock where there is no device or it ran nothing.
template <typename Answer>
Attempt timed(const gpu::Context* context, const std::function<Measured<Answer>()>& solve) {
  const double device_start = context == nullptr ? 0 : context->device_seconds();
  const double start = wall_seconds();
  Measured<Answer> measured = solve();
  const double wall = wall_seconds() - start;
  const double device = context == nullptr ? 0 : context->device_seconds() - device_start;
  return {std::move(measured.answer), measured.seconds.value_or(device > 0 ? device : wall)};
}

template <typename Problem, typename Answer>
std::vector<Method> methods_of(const StageRecord<Problem, Answer>& record) {
  std::vector<Method> methods;
  std::vector<bool> must_agree;
  for (const auto& method : record.cpu) {
    methods.push_back({method.name, Side::cpu});
    must_agree.push_back(method.must_agree);
  }
  for (const auto& method : record.gpu) {
    methods.push_back({method.name, Side::gpu});
    must_agree.push_back(true);
  }
  return link_judges(std::move(methods), must_agree);
}

}  // namespace detail

/// Takes the types off a record.
template <typename Problem, typename Answer>
Stage erase_types(StageRecord<Problem, Answer> record) {
  using Record = StageRecord<Problem, Answer>;
  const auto shared = std::make_shared<const Record>(std::move(record));
  const Record& r = *shared;
  const auto as_problem = [](const std::any& problem) -> const Problem& {
    return std::any_cast<const Problem&>(problem);
  };
  const auto as_answer = [](const Attempt& attempt) -> const Answer& {
    return std::any_cast<const Answer&>(attempt.answer);
  };
  Stage stage;
  stage.name = r.name;
  stage.title = r.title;
  stage.source = r.source;
  stage.why = r.why;
  stage.error_unit = r.error_unit;
  stage.rows = r.rows;
  stage.axes = r.axes;
  stage.methods = detail::methods_of(r);
  stage.chart_axes = r.chart_axes;
  stage.maps = r.maps;
  if (r.problem.of)
    stage.problem = [shared](const Setting& setting, const gpu::DeviceInfo& device) {
      return std::any(shared->problem.of(setting, device));
    };
  stage.tolerance = [=](const std::any& problem) {
    return shared->tolerance.of(as_problem(problem));
  };
  stage.attempt = [=](const std::any& any, std::size_t method, gpu::Context* context) {
    const Problem& problem = as_problem(any);
    const std::size_t cpu_count = shared->cpu.size();
    if (method < cpu_count)
      return detail::timed<Answer>(nullptr, [&] { return shared->cpu[method].solve(problem); });
    if (context == nullptr) throw Unsupported("no device");
    return detail::timed<Answer>(
        context, [&] { return shared->gpu.at(method - cpu_count).solve(*context, problem); });
  };
  if (r.distance.of)
    stage.distance = [=](const std::any& problem, const Attempt& got, const Attempt& want) {
      const double apart =
          detail::incomparable(numbers_of(as_answer(got)), numbers_of(as_answer(want)));
      return apart > 0 ? apart
                       : shared->distance.of(as_problem(problem), as_answer(got), as_answer(want));
    };
  if (r.error)
    stage.error = [=](const std::any& problem, const Attempt& attempt) {
      return shared->error(as_problem(problem), as_answer(attempt));
    };
  if (r.growth)
    stage.growth = [=](const std::any& problem, const Attempt& attempt) {
      return shared->growth(as_problem(problem), as_answer(attempt));
    };
  stage.problem_numbers = [=](const std::any& problem) { return numbers_of(as_problem(problem)); };
  stage.set_problem_numbers = [](std::any& problem, std::span<const double> numbers) {
    set_numbers(std::any_cast<Problem&>(problem), numbers);
  };
  stage.answer_numbers = [=](const Attempt& attempt) { return numbers_of(as_answer(attempt)); };
  stage.set_answer_numbers = [](Attempt& attempt, std::span<const double> numbers) {
    set_numbers(std::any_cast<Answer&>(attempt.answer), numbers);
  };
  return stage;
}

/// In a stage's file:
///   const Registration registration = register_stage<Problem, Answer>({.name = "ray/reflect",
///   ...});
template <typename Problem, typename Answer>
Registration register_stage(StageRecord<Problem, Answer> record) {
  return register_stage(erase_types(std::move(record)));
}

}  // namespace parity
