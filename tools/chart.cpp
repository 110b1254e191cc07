#include "tests/chart.h"

#include <cstdio>
#include <filesystem>
#include <memory>

#include "geometry/atomic_file.h"
#include "geometry/output_error.h"
#include "tools/chart_svg.h"
#include "tools/plot.h"
#include "tools/progress.h"
#include "tools/stage_chart.h"
#include "tools/verb.h"

namespace parity::tools {
namespace {

struct Options {
  std::vector<std::string> patterns;
  std::filesystem::path folder = "parity-charts";
  std::string device;
  bool json = false;
  bool list = false;
  bool quiet = false;
};

std::vector<Chart> select(const std::vector<std::string>& patterns) {
  std::vector<Chart> charts;
  for (const Chart& chart : all_charts())
    if (name_matches(chart.name, patterns)) charts.push_back(chart);
  for (const Stage& stage : all_stages())
    for (Chart& chart : charts_of(stage))
      if (name_matches(stage.name, patterns) || name_matches(chart.name, patterns))
        charts.push_back(std::move(chart));
  if (charts.empty())
    throw std::invalid_argument("chart: no chart of that name; see parity chart --list");
  return charts;
}

void write(const Options& options, const Chart& chart, const ChartData& data,
           const Provenance& provenance) {
  const std::filesystem::path stem = options.folder / file_stem(chart.name);
  write_file_atomically(stem.string() + ".svg", chart_svg(chart, data, provenance));
  write_file_atomically(stem.string() + ".csv", chart_csv(chart, data, provenance));
}

void print(const Options& options, const Chart& chart, const ChartData& data) {
  std::printf("%s: %s.svg, .csv\n", chart.name.c_str(),
              (options.folder / file_stem(chart.name)).string().c_str());
  for (const Assertion& assertion : data.assertions)
    std::printf("  %s  %s is %s, must be %s %s\n", assertion.holds() ? "ok  " : "FAIL",
                assertion.what.c_str(), three_digits(assertion.value).c_str(),
                assertion.relation == Assertion::Relation::at_most ? "at most" : "at least",
                three_digits(assertion.bound).c_str());
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw OutputError(folder.string(), error.message());
}

int chart(const Options& options) {
  const std::vector<Chart> charts = select(options.patterns);
  if (options.list) {
    for (const Chart& one : charts) std::printf("%s\n", one.name.c_str());
    return 0;
  }
  make_folder(options.folder);
  gpu::Context context({.device = options.device});
  const Provenance provenance = provenance_of(context);
  nlohmann::json all = nlohmann::json::array();
  bool broken = false;
  Progress progress("charting", charts.size(), options.quiet);
  for (const Chart& one : charts) {
    ChartData data;
    try {
      data = one.produce(context);
    } catch (const gpu::Error&) {
      throw;
    } catch (const std::exception& error) {
      progress.clear();
      std::fprintf(stderr, "parity: %s: %s\n", one.name.c_str(), error.what());
      broken = true;
      continue;
    }
    write(options, one, data, provenance);
    for (const Assertion& assertion : data.assertions) broken |= !assertion.holds();
    progress.clear();
    if (options.json)
      all.push_back(chart_json(one, data, provenance));
    else
      print(options, one, data);
    progress.advance();
  }
  progress.clear();
  if (options.json) std::printf("%s\n", all.dump(2).c_str());
  return broken ? 1 : 0;
}

}  // namespace

void add_chart_verb(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("chart", "Measure and draw error against time (SVG, CSV)");
  const auto options = std::make_shared<Options>();
  verb->add_option("GLOB", options->patterns, "Names, with * and ?; a folder stands for all in it");
  verb->add_option("-o,--output", options->folder, "Folder for the files");
  verb->add_option("--device", options->device, "Name or index of a device");
  verb->add_flag("--json", options->json, "Print everything that was measured");
  verb->add_flag("--list", options->list, "Print the names of the charts and measure nothing");
  verb->add_flag("-q,--quiet", options->quiet, "No progress");
  verb->footer(
      "Exits with 1 if a chart's assertion is broken.\n"
      "Examples:\n  parity chart raster -o charts\n  parity chart raster/depth_resolution --json");
  verb->callback([options, &exit_code] { exit_code = chart(*options); });
}

}  // namespace parity::tools
