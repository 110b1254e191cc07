#include "tests/conformance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/gpu_context.h"

namespace parity {

void PrintTo(const Check& check, std::ostream* out) { *out << check.name(); }

namespace {

std::string identifier(std::string name) {
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

/// Every stage at its standard setting and at both ends of every axis.
class Conformance : public testing::TestWithParam<Check> {};

TEST_P(Conformance, SidesAgree) {
  const CheckResult result = run_check(GetParam(), &test_context());
  if (result.outcome == CheckResult::Outcome::skipped) GTEST_SKIP() << result.message;
  EXPECT_EQ(result.outcome, CheckResult::Outcome::passed)
      << result.message << "\nreproduce: parity check '" << GetParam().name() << "'";
}

INSTANTIATE_TEST_SUITE_P(Stages, Conformance, testing::ValuesIn(checks_of(all_stages(), {})),
                         [](const auto& test) { return identifier(test.param.name()); });
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Conformance);

struct StageParam {
  const Stage* stage = nullptr;
};
void PrintTo(const StageParam& param, std::ostream* out) { *out << param.stage->name; }

/// The harness must notice when a stage's answer is wrong; so must the stage's own distance.
class Perturbed : public testing::TestWithParam<StageParam> {
 protected:
  /// The distance from the reference's answer to itself with number `index` replaced.
  double distance_after(const std::function<double(double)>& change) {
    const Stage& stage = *GetParam().stage;
    const std::any problem = make_problem(stage, Setting(stage.axes), &test_context());
    tolerance_ = stage.tolerance(problem);
    const Attempt want = stage.attempt(problem, 0, nullptr);
    std::vector<double> numbers = stage.answer_numbers(want);
    if (numbers.empty()) return std::numeric_limits<double>::infinity();
    for (double& number : numbers) number = change(number);
    Attempt got = want;
    stage.set_answer_numbers(got, numbers);
    return stage.distance(problem, got, want);
  }
  double tolerance_ = 0;
};

TEST_P(Perturbed, TheRightAnswerIsAccepted) {
  const double distance = distance_after([](double number) { return number; });
  EXPECT_LE(distance, tolerance_);
}

TEST_P(Perturbed, AWrongAnswerIsRejected) {
  const double distance =
      distance_after([](double number) { return number + 1 + std::abs(number) / 2; });
  EXPECT_FALSE(distance <= tolerance_);
}

std::vector<StageParam> stage_params() {
  std::vector<StageParam> params;
  for (const Stage& stage : all_stages()) params.push_back({&stage});
  return params;
}

INSTANTIATE_TEST_SUITE_P(Stages, Perturbed, testing::ValuesIn(stage_params()),
                         [](const auto& test) { return identifier(test.param.stage->name); });
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Perturbed);

}  // namespace
}  // namespace parity
