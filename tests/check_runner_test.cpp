#include "tools/check_runner.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include "geometry/input_error.h"
#include "tools/junit.h"
#include "tools/replay.h"

namespace parity::tools {
namespace {

using Values = std::vector<double>;

/// What the second method does wrong depends on the axis `fault`.
Values solve_badly(const Values& values) {
  Values answer = values;
  if (values[0] == 1) answer[1] = 7;
  if (values[0] == 2) std::raise(SIGKILL);
  if (values[0] == 3) std::this_thread::sleep_for(std::chrono::hours(1));
  if (values[0] == 4) throw std::runtime_error("no <luck>");
  if (values[0] == 5) throw Unsupported("not for five");
  return answer;
}

const Stage& faulty_stage() {
  static const Stage stage = erase_types<Values, Values>(
      {.name = "test/faulty",
       .title = "Copies that go wrong",
       .source = "none",
       .axes = {{.name = "fault", .low = 0, .high = 9, .standard = 0}},
       .problem =
           [](const Setting& setting) {
             return Values{setting.at("fault"), 1, 2};
           },
       .cpu = {{.solve = [](const Values& values) { return values; }},
               {.name = "bad", .solve = solve_badly, .must_agree = true}},
       .distance = [](const Values& got, const Values& want) { return std::abs(got[1] - want[1]); },
       .tolerance = 0.0,
       .why = "copies are exact"});
  return stage;
}

std::filesystem::path scratch() {
  return std::filesystem::path(testing::TempDir()) / "parity_check_runner_test";
}

std::vector<CheckReport> run_faults(const std::vector<double>& faults,
                                    std::optional<Values> problem = std::nullopt) {
  std::vector<Check> checks;
  for (double fault : faults) {
    Setting setting(faulty_stage().axes);
    setting.set("fault", fault);
    checks.push_back({&faulty_stage(), {"fault=" + short_number(fault), setting}});
  }
  std::vector<CheckReport> reports;
  const CheckRunOptions options{.host_only = true,
                                .timeout_seconds = 0.3,
                                .folder = scratch(),
                                .problem = std::move(problem)};
  run_checks(checks, options, [&](const CheckReport& report) { reports.push_back(report); });
  return reports;
}

TEST(CheckRunner, GoesOnAfterEveryKindOfFailure) {
  const std::vector<CheckReport> reports = run_faults({0, 1, 2, 3, 4, 5, 0});
  ASSERT_EQ(reports.size(), 7u);
  EXPECT_EQ(reports[0].outcome, "passed");
  EXPECT_EQ(reports[1].outcome, "failed");
  EXPECT_NE(reports[1].message.find("6 from cpu reference, tolerance 0 (copies are exact)"),
            std::string::npos);
  EXPECT_EQ(reports[2].message, "crashed: Killed");
  EXPECT_EQ(reports[3].message, "timed out after 0.3 s");
  EXPECT_EQ(reports[4].message, "no <luck>");
  EXPECT_EQ(reports[5].outcome, "skipped");
  EXPECT_EQ(reports[5].message, "cpu bad: not for five");
  EXPECT_EQ(reports[6].outcome, "passed");
  EXPECT_EQ(reports[6].name, "test/faulty/fault=0");
}

TEST(CheckRunner, FailuresNameTheirCommand) {
  const std::vector<CheckReport> reports = run_faults({1, 2});
  EXPECT_NE(reports[0].reproduce.find("parity check test/faulty --replay "), std::string::npos);
  EXPECT_EQ(reports[1].reproduce, "parity check test/faulty --setting fault=2");
}

TEST(CheckRunner, AProblemCanBeReplaced) {
  EXPECT_EQ(run_faults({0}, Values{1, 5, 5})[0].outcome, "failed");
}

TEST(CheckRunner, JunitEscapesWhatXmlWouldRead) {
  const std::string xml = junit_xml(run_faults({0, 4}));
  EXPECT_NE(xml.find("tests=\"2\" failures=\"1\""), std::string::npos);
  EXPECT_NE(xml.find("<failure message=\"no &lt;luck&gt;\">"), std::string::npos);
}

TEST(Replay, HoldsProblemAnswersAndDifference) {
  run_faults({1});
  const nlohmann::json file =
      nlohmann::json::parse(std::ifstream(scratch() / "test-faulty-fault=1.json"));
  EXPECT_EQ(file.at("problem"), (nlohmann::json{1.0, 1.0, 2.0}));
  EXPECT_EQ(file.at("answers")[1].at("answer"), (nlohmann::json{1.0, 7.0, 2.0}));
  EXPECT_EQ(file.at("answers")[1].at("difference"), (nlohmann::json{0.0, 6.0, 0.0}));
}

TEST(Replay, RefusesWhatIsNoReplayFile) {
  std::filesystem::create_directories(scratch());
  const std::filesystem::path path = scratch() / "bad.json";
  for (const char* text : {"", "[1]", "{\"stage\": \"no/such\"}", "{\"stage\": 3}"}) {
    std::ofstream(path) << text;
    EXPECT_THROW(read_replay(path), InputError) << text;
  }
  EXPECT_THROW(read_replay(scratch() / "missing.json"), InputError);
}

}  // namespace
}  // namespace parity::tools
