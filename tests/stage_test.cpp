#include "tests/stage.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "gpu/core/commands.h"
#include "tests/gpu_context.h"

namespace parity {
namespace {

using Values = std::vector<float>;

Values doubled(const Values& values) {
  Values result;
  for (float value : values) result.push_back(2 * value);
  return result;
}

double largest_difference(const Values& got, const Values& want) {
  double largest = 0;
  for (std::size_t i = 0; i < got.size(); ++i)
    largest = std::max(largest, double(std::abs(got[i] - want[i])));
  return largest;
}

/// Doubling numbers, with a device side that is the host's answer after `fault`.
Stage doubling(const std::function<void(Values&)>& fault) {
  return erase_types<Values, Values>(
      {.name = "test/doubling",
       .title = "Twice each number",
       .source = "arithmetic",
       .axes = {{.name = "count", .unit = "1", .low = 1, .high = 9, .standard = 4}},
       .problem = [](const Setting& setting) { return Values(setting.count("count"), 1.5f); },
       .cpu = {{.solve = [](const Values& values) { return doubled(values); }},
               {.name = "faulty",
                .solve =
                    [fault](const Values& values) {
                      Values answer = doubled(values);
                      fault(answer);
                      return Measured<Values>(answer, 0.25);
                    },
                .must_agree = true}},
       .gpu = {{.solve = [](gpu::Context&, const Values& values) { return doubled(values); }}},
       .distance = largest_difference,
       .tolerance = 0.0,
       .why = "doubling is exact",
       .error = [](const Values&, const Values& answer) { return std::abs(answer[0] - 3.0); }});
}

Trial run_with(const std::function<void(Values&)>& fault) {
  const Stage stage = doubling(fault);
  const Setting setting(stage.axes);
  return run_stage(stage, setting, nullptr, stage.problem(setting, {}));
}

TEST(Stage, AcceptsTheRightAnswer) {
  const Trial trial = run_with([](Values&) {});
  EXPECT_TRUE(trial.passed());
  ASSERT_EQ(trial.methods.size(), 3u);
  EXPECT_EQ(trial.methods[1].distance, 0.0);
  EXPECT_EQ(trial.methods[1].error, 0.0);
  EXPECT_EQ(trial.methods[1].seconds, 0.25);
  EXPECT_EQ(trial.methods[2].skipped, "no device");
}

// Compiling, uploads and the host's own work do not count.
TEST(Stage, TimesTheDeviceByItsOwnClock) {
  double ran = 0;
  Stage stage = erase_types<Values, Values>(
      {.name = "test/clock",
       .title = "A run between two",
       .source = "none",
       .problem = [](const Setting&) { return Values(1); },
       .cpu = {{.solve = [](const Values& values) { return values; }}},
       .gpu = {{.solve =
                    [&](gpu::Context& context, const Values& values) {
                      const gpu::Buffer<float> buffer(context, values);
                      for (int i = 0; i < 2; ++i)
                        ran += context.run([&](gpu::Commands& c) { c.fill(buffer, 0); }).seconds;
                      return values;
                    }}},
       .distance = largest_difference,
       .tolerance = 0.0,
       .why = "equal"});
  test_context().run([](gpu::Commands&) {});
  const Trial trial = run_stage(stage, Setting(stage.axes), &test_context());
  EXPECT_GT(ran, 0);
  // The sum was taken from a larger one, with a rounding of that at each step.
  EXPECT_NEAR(trial.methods[1].seconds, ran, 4 * 0x1p-53 * test_context().device_seconds());
}

TEST(Stage, RejectsOneWrongNumber) {
  EXPECT_FALSE(run_with([](Values& answer) { answer.back() += 1e-6f; }).passed());
}

TEST(Stage, RejectsNanEvenIfTheDistanceSwallowsIt) {
  EXPECT_FALSE(run_with([](Values& answer) {
                 answer[1] = std::numeric_limits<float>::quiet_NaN();
               }).passed());
}

TEST(Stage, RejectsAnAnswerOfAnotherLength) {
  EXPECT_FALSE(run_with([](Values& answer) { answer.pop_back(); }).passed());
  EXPECT_FALSE(run_with([](Values& answer) { answer.push_back(3.0f); }).passed());
}

TEST(Stage, DistanceOfNanFails) {
  Trial trial;
  trial.tolerance = 1;
  trial.methods.push_back({.method = "gpu x", .distance = std::nan("")});
  EXPECT_FALSE(trial.passed());
}

TEST(Stage, RefusesAnIncompleteRecord) {
  Stage stage = doubling([](Values&) {});
  stage.why.clear();
  EXPECT_THROW(register_stage(stage), std::logic_error);
}

TEST(Stage, ProblemsComeBackFromTheirNumbers) {
  const Stage stage = doubling([](Values&) {});
  std::any problem = stage.problem(Setting(stage.axes), {});
  stage.set_problem_numbers(problem, std::array{1.0, 2.0, 3.0, 4.0});
  EXPECT_EQ(stage.problem_numbers(problem), (std::vector<double>{1, 2, 3, 4}));
  EXPECT_THROW(stage.set_problem_numbers(problem, std::array{1.0}), std::invalid_argument);
}

TEST(Numbers, AreVisitedInOrderOfStorage) {
  const std::vector<Trs> poses{{.translation = {1, 2, 3}, .scale = {8, 9, 10}}};
  EXPECT_EQ(numbers_of(poses), (std::vector<double>{1, 2, 3, 0, 0, 0, 1, 8, 9, 10}));
  dmat2 matrix{0.0};
  set_numbers(matrix, std::array{1.0, 2.0, 3.0, 4.0});
  EXPECT_EQ(matrix[1][0], 3.0);
}

TEST(Setting, ConformanceTakesBothEndsOfEveryAxis) {
  const std::vector<Axis> axes{{.name = "n", .low = 1, .high = 8, .standard = 1},
                               {.name = "h", .low = 0.5, .high = 2, .standard = 1}};
  std::vector<std::string> names;
  for (const NamedSetting& named : conformance_settings(axes)) names.push_back(named.name);
  EXPECT_EQ(names, (std::vector<std::string>{"standard", "n=8", "h=0.5", "h=2"}));
}

TEST(Setting, ConformanceTakesEveryKind) {
  const std::vector<Axis> axes{{.name = "kind", .low = 0, .high = 3, .standard = 1, .each = true}};
  std::vector<std::string> names;
  for (const NamedSetting& named : conformance_settings(axes)) names.push_back(named.name);
  EXPECT_EQ(names, (std::vector<std::string>{"standard", "kind=0", "kind=2", "kind=3"}));
}

TEST(Setting, StepsAreEqualInTheLogarithm) {
  const Axis axis{.name = "n", .low = 1, .high = 100, .logarithmic = true, .whole = true};
  EXPECT_EQ(steps_along(axis, 3), (std::vector<double>{1, 10, 100}));
}

TEST(Setting, NamesAnUnknownAxis) {
  Setting setting;
  EXPECT_THROW(setting.set("width", 1), std::invalid_argument);
}

TEST(Names, MatchGlobsAndFolders) {
  const auto matches = [](const char* name, const char* pattern) {
    return name_matches(name, std::vector<std::string>{pattern});
  };
  EXPECT_TRUE(matches("raster/edge_coverage", "raster"));
  EXPECT_TRUE(matches("raster/edge_coverage", "*edge*"));
  EXPECT_TRUE(matches("raster/edge_coverage", "all"));
  EXPECT_FALSE(matches("raster/edge_coverage", "rast"));
  EXPECT_TRUE(name_matches("anything", {}));
}

}  // namespace
}  // namespace parity
