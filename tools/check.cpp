#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "geometry/atomic_file.h"
#include "tools/check_runner.h"
#include "tools/junit.h"
#include "tools/options.h"
#include "tools/progress.h"
#include "tools/replay.h"
#include "tools/verb.h"

namespace parity::tools {
namespace {

struct Options {
  std::vector<std::string> patterns;
  std::vector<std::string> settings;
  std::string shard;
  std::string junit;
  std::string replay;
  std::uint64_t seed = 1;
  bool json = false;
  bool list = false;
  bool quiet = false;
  bool no_validation = false;
  CheckRunOptions run{.device = {}, .folder = "parity-failures", .problem = {}};
};

std::pair<std::string, double> parse_setting(const std::string& text) {
  const std::size_t equals = text.find('=');
  double value = 0;
  int used = 0;
  if (equals == std::string::npos ||
      std::sscanf(text.c_str() + equals + 1, "%lf%n", &value, &used) != 1 ||
      equals + 1 + static_cast<std::size_t>(used) != text.size())
    throw std::invalid_argument("--setting " + text + ": must be AXIS=NUMBER");
  return {text.substr(0, equals), value};
}

/// One check a stage, at the standard setting with these values instead.
std::vector<Check> checks_at(const Options& options) {
  std::vector<Check> checks;
  for (const Stage& stage : all_stages()) {
    if (!name_matches(stage.name, options.patterns)) continue;
    Setting setting(stage.axes);
    setting.seed = options.seed;
    std::string name = "seed=" + std::to_string(options.seed);
    for (const std::string& text : options.settings) {
      const auto [axis, value] = parse_setting(text);
      setting.set(axis, value);
      name += "," + axis + "=" + short_number(value);
    }
    checks.push_back({&stage, {name, setting}});
  }
  return checks;
}

std::vector<Check> replayed(Options& options) {
  Replay replay = read_replay(options.replay);
  if (!name_matches(replay.stage, options.patterns))
    throw std::invalid_argument("--replay " + options.replay + ": is of " + replay.stage);
  if (!replay.problem.empty()) options.run.problem = std::move(replay.problem);
  const auto stage = std::ranges::find(all_stages(), replay.stage, &Stage::name);
  return {{&*stage, {"replay", replay.setting}}};
}

/// Every n-th, beginning with the k-th; 1 <= k <= n.
std::vector<Check> shard_of(const std::vector<Check>& checks, const std::string& text) {
  unsigned k = 0, n = 0;
  char end = 0;
  if (std::sscanf(text.c_str(), "%u/%u%c", &k, &n, &end) != 2 || k < 1 || k > n)
    throw std::invalid_argument("--shard " + text + ": must be K/N with 1 <= K <= N");
  std::vector<Check> part;
  for (std::size_t i = k - 1; i < checks.size(); i += n) part.push_back(checks[i]);
  return part;
}

std::vector<Check> select(Options& options) {
  std::vector<Check> checks;
  if (!options.replay.empty())
    checks = replayed(options);
  else if (!options.settings.empty() || options.seed != 1)
    checks = checks_at(options);
  else
    checks = checks_of(all_stages(), options.patterns);
  if (checks.empty()) throw std::invalid_argument("check: no stage of that name; see parity list");
  return options.shard.empty() ? checks : shard_of(checks, options.shard);
}

void print(const CheckReport& report) {
  const char* mark = report.outcome == "passed"   ? "ok  "
                     : report.outcome == "failed" ? "FAIL"
                                                  : "skip";
  std::printf("%s  %s  %.0f ms\n", mark, report.name.c_str(), 1000 * report.seconds);
  if (!report.message.empty()) std::printf("      %s\n", report.message.c_str());
  if (!report.reproduce.empty()) std::printf("      reproduce: %s\n", report.reproduce.c_str());
  std::fflush(stdout);
}

std::size_t count(const std::vector<CheckReport>& reports, const std::string& outcome) {
  return static_cast<std::size_t>(std::ranges::count(reports, outcome, &CheckReport::outcome));
}

nlohmann::json to_json(const std::vector<CheckReport>& reports, const std::string& device) {
  nlohmann::json checks = nlohmann::json::array();
  for (const CheckReport& report : reports)
    checks.push_back({{"name", report.name},
                      {"outcome", report.outcome},
                      {"message", report.message},
                      {"reproduce", report.reproduce},
                      {"seconds", report.seconds},
                      {"methods", report.methods}});
  return {{"version", 1},
          {"device", device},
          {"passed", count(reports, "passed")},
          {"failed", count(reports, "failed")},
          {"skipped", count(reports, "skipped")},
          {"checks", checks}};
}

int check(Options& options) {
  const std::vector<Check> checks = select(options);
  if (options.list) {
    for (const Check& one : checks) std::printf("%s\n", one.name().c_str());
    return 0;
  }
  options.run.validation = !options.no_validation;
  std::vector<CheckReport> reports;
  Progress progress("checking", checks.size(), options.quiet || !can_redraw(stderr));
  const std::string device = run_checks(checks, options.run, [&](const CheckReport& report) {
    reports.push_back(report);
    progress.clear();
    const bool worth_a_line = !options.quiet || report.outcome == "failed";
    if (!options.json && worth_a_line) print(report);
    progress.advance();
  });
  progress.clear();
  if (!options.junit.empty()) write_file_atomically(options.junit, junit_xml(reports));
  if (options.json)
    std::printf("%s\n", to_json(reports, device).dump(2).c_str());
  else
    std::printf("%zu passed, %zu failed, %zu skipped on %s\n", count(reports, "passed"),
                count(reports, "failed"), count(reports, "skipped"), device.c_str());
  return count(reports, "failed") == 0 ? 0 : 1;
}

}  // namespace

void add_check_verb(CLI::App& app, int& exit_code) {
  CLI::App* verb =
      app.add_subcommand("check", "Hold the stages' device side against the reference");
  const auto options = std::make_shared<Options>();
  verb->add_option("GLOB", options->patterns, "Names, with * and ?; a folder stands for all in it");
  verb->add_flag("--json", options->json, "Machine-readable output");
  verb->add_option("--junit", options->junit, "Write a JUnit report to this file");
  verb->add_flag("--list", options->list, "Print the names of the checks and run none");
  verb->add_option("--shard", options->shard, "K/N: run every N-th check from the K-th");
  verb->add_option("--timeout", options->run.timeout_seconds, "Seconds that one check may take")
      ->check(within(1e-3, 1e6));
  verb->add_option("--setting", options->settings, "AXIS=VALUE: one check a stage at this setting");
  verb->add_option("--seed", options->seed, "Seed of random problems");
  verb->add_option("-o,--output", options->run.folder, "Folder for the files of failures");
  verb->add_option("--replay", options->replay, "Run the problem of this file of a failure");
  verb->add_option("--device", options->run.device, "Name or index of a device");
  verb->add_flag("--no-validation", options->no_validation, "Without the validation layer");
  verb->add_flag("-q,--quiet", options->quiet, "Print failures only");
  verb->footer(
      "Examples:\n  parity check\n  parity check raster --junit report.xml --shard 1/4\n"
      "  parity check raster/edge_coverage --setting width=131");
  verb->callback([options, &exit_code] { exit_code = check(*options); });
}

}  // namespace parity::tools
