#include "gpu/sampling/antialias.h"

#include <algorithm>
#include <filesystem>
#include <functional>

#include "cpu_reference/sampling/pattern.h"
#include "geometry/flip.h"
#include "geometry/scene_io.h"
#include "gpu/raster/renderer.h"
#include "tests/chart.h"
#include "tests/shared_data.h"
#include "tests/stage.h"
#include "tests/statistics.h"

namespace parity {
namespace {

struct Way {
  std::string name;
  std::function<Picture()> draw;
  std::vector<double> seconds = {};
  double error = 0;
};

std::vector<dvec2> shifts_of(int frames) {
  std::vector<dvec2> shifts = cpu::pattern(SamplePattern::multi_jittered, std::uint32_t(frames), 1);
  for (dvec2& shift : shifts) shift -= 0.5;
  return shifts;
}

/// Times all ways by turns, three times, after one turn that is not counted.
void measure(std::vector<Way>& ways, const Grid<vec4>& truth) {
  for (int turn = 0; turn < 4; ++turn)
    for (Way& way : ways) {
      const double start = detail::wall_seconds();
      const Picture picture = way.draw();
      if (turn > 0) way.seconds.push_back(detail::wall_seconds() - start);
      way.error = mean(flip(truth, picture.color, usual_pixels_per_degree));
    }
}

/// One scene: error of each way against 64 frames, and time.
///
/// @param is_bound  adaptive must be as good as 8 frames in a third of their time. Not so where
///                  textures differ from pixel to pixel all over: then nearly all is to be refined.
void add_scene(gpu::Context& context, const std::string& name, const Scene& scene, bool is_bound,
               ChartData& data) {
  FrameOptions options{.width = 1280, .height = 960, .background = {0.03f, 0.03f, 0.04f, 1}};
  const auto frame = [&](int samples) {
    options.samples = samples;
    return make_frame(scene, options);
  };
  gpu::Antialiaser antialiaser(context, scene);
  gpu::Renderer renderer(context, scene);
  const Grid<vec4> truth = antialiaser.accumulate(frame(1), shifts_of(64)).color;
  std::vector<Way> ways{
      {"none", [&] { return renderer.render(frame(1)); }},
      {"msaa4", [&] { return renderer.render(frame(4)); }},
      {"adaptive", [&] { return antialiaser.adaptive(frame(1), 0.04f, 1); }},
      {"8 frames", [&] { return antialiaser.accumulate(frame(1), shifts_of(8)); }}};
  measure(ways, truth);
  Series series{name, {}};
  for (const Way& way : ways)
    series.points.push_back({1e3 * median(way.seconds), way.error, way.name});
  std::ranges::sort(series.points, {}, &Point::x);
  data.series.push_back(series);
  if (!is_bound) return;
  data.assertions.push_back(
      {name + ": FLIP of adaptive over that of 8 frames", ways[2].error / ways[3].error, 1});
  data.assertions.push_back({name + ": time of adaptive over that of 8 frames",
                             median(ways[2].seconds) / median(ways[3].seconds), 1.0 / 3});
}

ChartData quality_for_time(gpu::Context& context) {
  ChartData data;
  const std::filesystem::path source = PARITY_SOURCE_DIR;
  add_scene(context, "sphere_grid.glb", load_scene(source / "assets/sphere_grid.glb"), true, data);
  const std::vector<std::pair<const char*, bool>> scenes{{"Fox/Fox.gltf", true},
                                                         {"2CylinderEngine.glb", true},
                                                         {"ManyCubes/many-cubes.gltf", true},
                                                         {"FlightHelmet/FlightHelmet.gltf", false}};
  for (const auto& [name, is_bound] : scenes)
    if (const auto path = shared_data(std::string("data/gltf/") + name))
      add_scene(context, name, load_scene(*path), is_bound, data);
  data.settings = {{"picture", "1280x960"},
                   {"truth", "64 multi-jittered frames"},
                   {"time", "whole call with readback, median of 3, by turns"}};
  return data;
}

const Registration chart = register_chart({
    .name = "sampling/antialiasing",
    .title = "Antialiasing whole pictures: error against time",
    .x = {.label = "time", .unit = "ms"},
    .y = {.label = "mean FLIP"},
    .produce = quality_for_time,
});

}  // namespace
}  // namespace parity
