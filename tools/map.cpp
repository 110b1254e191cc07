#include <cstdio>
#include <filesystem>
#include <memory>

#include "geometry/atomic_file.h"
#include "geometry/output_error.h"
#include "tools/map_data.h"
#include "tools/map_svg.h"
#include "tools/progress.h"
#include "tools/verb.h"

namespace parity::tools {
namespace {

struct Options {
  std::vector<std::string> patterns;
  std::filesystem::path folder = "parity-maps";
  std::string device;
  bool json = false;
  bool list = false;
  bool quiet = false;
};

std::vector<Map> select(const std::vector<std::string>& patterns) {
  std::vector<Map> maps;
  for (const Map& map : all_maps())
    if (name_matches(map.name, patterns)) maps.push_back(map);
  for (const Stage& stage : all_stages())
    for (Map& map : maps_of(stage))
      if (name_matches(stage.name, patterns) || name_matches(map.name, patterns))
        maps.push_back(std::move(map));
  if (maps.empty()) throw std::invalid_argument("map: no map of that name; see parity map --list");
  return maps;
}

int draw_maps(const Options& options) {
  const std::vector<Map> maps = select(options.patterns);
  if (options.list) {
    for (const Map& map : maps) std::printf("%s\n", map.name.c_str());
    return 0;
  }
  std::error_code error;
  std::filesystem::create_directories(options.folder, error);
  if (error) throw OutputError(options.folder.string(), error.message());
  gpu::Context context({.device = options.device});
  const Provenance provenance = provenance_of(context);
  nlohmann::json all = nlohmann::json::array();
  for (const Map& map : maps) {
    Progress progress(map.name, static_cast<std::size_t>(map.columns * map.rows), options.quiet);
    const MapData data = measure_map(
        map, [&](double x, double y) { return map.value(context, x, y); },
        [&] { progress.advance(); });
    progress.clear();
    const std::string stem = (options.folder / file_stem(map.name)).string();
    write_file_atomically(stem + ".svg", map_svg(map, data, provenance));
    write_file_atomically(stem + ".csv", map_csv(map, data, provenance));
    const nlohmann::json json = map_json(map, data, provenance);
    write_file_atomically(stem + ".json", json.dump(1) + "\n");
    if (options.json)
      all.push_back(json);
    else
      std::printf("%s: %s.svg, .csv, .json\n", map.name.c_str(), stem.c_str());
  }
  if (options.json) std::printf("%s\n", all.dump(2).c_str());
  return 0;
}

}  // namespace

void add_map_verb(CLI::App& app, int& exit_code) {
  CLI::App* verb =
      app.add_subcommand("map", "Draw where a method fails, with theory over it (SVG, CSV, JSON)");
  const auto options = std::make_shared<Options>();
  verb->add_option("GLOB", options->patterns, "Names, with * and ?; a folder stands for all in it");
  verb->add_option("-o,--output", options->folder, "Folder for the files");
  verb->add_option("--device", options->device, "Name or index of a device");
  verb->add_flag("--json", options->json, "Print everything that was measured");
  verb->add_flag("--list", options->list, "Print the names of the maps and measure nothing");
  verb->add_flag("-q,--quiet", options->quiet, "No progress");
  verb->footer("Examples:\n  parity map raster -o maps\n  parity map raster/z_fighting --json");
  verb->callback([options, &exit_code] { exit_code = draw_maps(*options); });
}

}  // namespace parity::tools
