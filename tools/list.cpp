#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "tests/stage.h"
#include "tools/verb.h"

namespace parity::tools {
namespace {

double standard_tolerance(const Stage& stage) {
  return stage.tolerance(stage.problem(Setting(stage.axes), gpu::DeviceInfo{}));
}

nlohmann::json to_json(const Axis& axis) {
  return {{"name", axis.name},   {"unit", axis.unit},         {"low", axis.low},
          {"high", axis.high},   {"standard", axis.standard}, {"logarithmic", axis.logarithmic},
          {"whole", axis.whole}, {"each", axis.each}};
}

nlohmann::json to_json(const Stage& stage) {
  nlohmann::json axes = nlohmann::json::array();
  for (const Axis& axis : stage.axes) axes.push_back(to_json(axis));
  nlohmann::json sides = nlohmann::json::array();
  for (const Method& method : stage.methods) sides.push_back(method.label());
  return {{"name", stage.name},
          {"title", stage.title},
          {"source", stage.source},
          {"rows", stage.rows},
          {"axes", axes},
          {"tolerance", standard_tolerance(stage)},
          {"why", stage.why},
          {"sides", sides},
          {"error_unit", stage.error ? nlohmann::json(stage.error_unit) : nlohmann::json()},
          {"maps", stage.maps.size()}};
}

void print(const Stage& stage) {
  std::string rows;
  for (int row : stage.rows) rows += (rows.empty() ? "" : ", ") + std::to_string(row);
  std::printf("%s\n   %s\n   %s; checklist %s\n", stage.name.c_str(), stage.title.c_str(),
              stage.source.c_str(), rows.empty() ? "-" : rows.c_str());
  for (const Axis& axis : stage.axes)
    std::printf("   %s: %s to %s%s, standard %s\n", axis.name.c_str(),
                short_number(axis.low).c_str(), short_number(axis.high).c_str(),
                axis.unit == "1" ? "" : (" " + axis.unit).c_str(),
                short_number(axis.standard).c_str());
  std::string sides;
  for (const Method& method : stage.methods) sides += (sides.empty() ? "" : ", ") + method.label();
  std::printf("   sides: %s\n   tolerance %s: %s\n", sides.c_str(),
              short_number(standard_tolerance(stage)).c_str(), stage.why.c_str());
}

void list(const std::vector<std::string>& patterns, bool json) {
  nlohmann::json array = nlohmann::json::array();
  for (const Stage& stage : all_stages()) {
    if (!name_matches(stage.name, patterns)) continue;
    if (json)
      array.push_back(to_json(stage));
    else
      print(stage);
  }
  if (json) std::printf("%s\n", array.dump(2).c_str());
}

}  // namespace

void add_list_verb(CLI::App& app, int& exit_code) {
  struct Options {
    std::vector<std::string> patterns;
    bool json = false;
  };
  CLI::App* verb = app.add_subcommand("list", "List the stages: what is computed, how it is held");
  const auto options = std::make_shared<Options>();
  verb->add_option("GLOB", options->patterns, "Names, with * and ?; a folder stands for all in it");
  verb->add_flag("--json", options->json, "An array of stages");
  verb->footer("Examples:\n  parity list raster\n  parity list --json '*/slerp'");
  verb->callback([options, &exit_code] {
    list(options->patterns, options->json);
    exit_code = 0;
  });
}

}  // namespace parity::tools
