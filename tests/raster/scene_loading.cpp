#include <cmath>

#include "tests/chart.h"
#include "tests/loading_cost.h"
#include "tests/statistics.h"
#include "tests/temporary_folder.h"

/// What it takes to load a scene.
namespace parity {
namespace {

struct Sample {
  double triangles = 0;
  double file_bytes = 0;
  double seconds = 0;  ///< median of 3
  double bytes = 0;    ///< largest of 3
};

std::vector<Sample> measure() {
  const TemporaryFolder folder;
  std::vector<Sample> samples;
  for (const std::uint32_t side : {22u, 71u, 224u, 708u, 1000u}) {
    const auto file = folder.write("square.glb", waved_square(side));
    Sample sample{.file_bytes = double(std::filesystem::file_size(file))};
    std::vector<double> seconds;
    for (int repetition = 0; repetition < 3; ++repetition) {
      const LoadingCost cost = cost_of_loading(file);
      if (cost.triangles == 0) throw std::runtime_error("the scene could not be loaded");
      sample.triangles = double(cost.triangles);
      sample.bytes = std::max(sample.bytes, double(cost.bytes));
      seconds.push_back(cost.wall);
    }
    sample.seconds = median(seconds);
    samples.push_back(sample);
  }
  return samples;
}

constexpr std::size_t million = 3;

ChartData loading_time(gpu::Context&) {
  Series load{"cpu load_scene", {}};
  const std::vector<Sample> samples = measure();
  for (const Sample& s : samples) load.points.push_back({s.triangles, 1e3 * s.seconds});
  return {.series = {load},
          .assertions = {{"seconds for 1,000,000 triangles", samples[million].seconds, 2}},
          .settings = {{"file", "GLB with normals and texture coordinates"},
                       {"timed", "by the wall in a process of its own; medians of 3"}}};
}

ChartData loading_memory(gpu::Context&) {
  Series grown{"cpu load_scene, most", {}};
  Series file{"the file", {}, Series::Kind::theory};
  Series allowed{"4 times the file", {}, Series::Kind::theory};
  const std::vector<Sample> samples = measure();
  constexpr double mebibyte = 1 << 20;
  for (const Sample& s : samples) {
    grown.points.push_back({s.triangles, s.bytes / mebibyte});
    file.points.push_back({s.triangles, s.file_bytes / mebibyte});
    allowed.points.push_back({s.triangles, 4 * s.file_bytes / mebibyte});
  }
  return {.series = {grown, file, allowed},
          .assertions = {{"memory over size of the file, 1,000,000 triangles",
                          samples[million].bytes / samples[million].file_bytes, 4}},
          .settings = {{"file", "GLB with normals and texture coordinates"},
                       {"measured", "what a process of its own grew by; largest of 3"}}};
}

const Registration time_chart = register_chart({
    .name = "raster/scene_loading_time",
    .title = "Time to load and check a scene",
    .x = {.label = "triangles"},
    .y = {.label = "time", .unit = "ms"},
    .produce = loading_time,
    .fit_slopes = true,
});

const Registration memory_chart = register_chart({
    .name = "raster/scene_loading_memory",
    .title = "Memory to load and check a scene",
    .x = {.label = "triangles"},
    .y = {.label = "memory", .unit = "MiB"},
    .produce = loading_memory,
});

}  // namespace
}  // namespace parity
