#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <string>

#include "geometry/scene_io.h"
#include "geometry/texture_levels.h"
#include "gpu/raster/renderer.h"
#include "tests/chart.h"
#include "tests/shared_data.h"
#include "tests/texture/textured_square.h"

/// What leaving out the texture levels that no pixel reads saves.
namespace parity {
namespace {

double seconds_of(const std::function<void()>& action) {
  double least = 1e9;
  for (int i = 0; i < 3; ++i) {
    const double start = detail::wall_seconds();
    action();
    least = std::min(least, detail::wall_seconds() - start);
  }
  return least;
}

/// Of textures on the device, and seconds until the first picture.
struct Cost {
  double bytes = 0;
  double seconds = 0;
};

Cost cost_of(gpu::Context& context, const Scene& scene, const Frame& frame, bool all) {
  Cost cost;
  cost.seconds = seconds_of([&] {
    std::vector<LevelRange> levels;
    if (!all) levels = read_levels(scene, frame);
    gpu::Renderer renderer(context, scene, {}, std::move(levels));
    cost.bytes = double(renderer.render(frame).memory_bytes);
  });
  return cost;
}

struct CostSeries {
  Series all{"all levels", {}};
  Series read{"levels that are read", {}};
};

ChartData costs(gpu::Context& context, bool in_seconds) {
  CostSeries series;
  double far_ratio = 1, worst_ratio = 0;
  for (double distance = 0.5; distance < 600; distance *= 2) {
    const Scene scene = texture_test::textured_square(1024, 5 - distance,
                                                      {.max_anisotropy = default_max_anisotropy});
    const Frame frame = make_frame(scene, {.width = 256, .height = 256});
    const Cost all = cost_of(context, scene, frame, true);
    const Cost read = cost_of(context, scene, frame, false);
    series.all.points.push_back({distance, in_seconds ? all.seconds * 1e3 : all.bytes});
    series.read.points.push_back({distance, in_seconds ? read.seconds * 1e3 : read.bytes});
    far_ratio = read.bytes / all.bytes;
    worst_ratio = std::max(worst_ratio, read.bytes / all.bytes);
  }
  ChartData data{{series.all, series.read}};
  if (!in_seconds)
    data.assertions = {
        {.what = "bytes of what is read / of all, from afar", .value = far_ratio, .bound = 0.4},
        {.what = "the same, anywhere", .value = worst_ratio, .bound = 1.0}};
  data.settings = {{"scene", "a square of 2 m with 1024 x 1024 texels, 256 x 256 px, 23 degrees"}};
  return data;
}

struct NamedScene {
  std::string name;
  Scene scene;
};

/// Scenes of others where they are at hand, and one that is made.
std::vector<NamedScene> textured_scenes() {
  std::vector<NamedScene> scenes;
  scenes.push_back({"ball", texture_test::textured_ball(512)});
  scenes.push_back(
      {"demo", load_scene(std::filesystem::path(PARITY_SOURCE_DIR) / "assets/demo.glb")});
  for (const char* name : {"Fox", "FlightHelmet", "TextureSettingsTest", "AnisotropyBarnLamp"})
    if (const auto file = shared_data(fmt::format("data/gltf/{0}/{0}.gltf", name)))
      scenes.push_back({name, load_scene(*file)});
  for (NamedScene& scene : scenes)
    for (Texture& t : scene.scene.textures) t.sampler.max_anisotropy = default_max_anisotropy;
  return scenes;
}

ChartData shares_of_scenes(gpu::Context& context) {
  ChartData data;
  for (const NamedScene& named : textured_scenes()) {
    Series series{.name = named.name, .points = {}};
    for (const int width : {48, 96, 192, 384, 768}) {
      const Frame frame =
          make_frame(named.scene, {.width = width, .height = width * 2 / 3, .samples = 4});
      const auto bytes = [&](std::vector<LevelRange> levels) {
        return double(
            gpu::Renderer(context, named.scene, {}, std::move(levels)).render(frame).memory_bytes);
      };
      // What is no texture is the same in both.
      const double none = bytes(std::vector<LevelRange>(named.scene.images.size()));
      const double all = bytes({}) - none;
      series.points.push_back(
          {double(width), (bytes(read_levels(named.scene, frame)) - none) / all});
    }
    if (named.name != "demo")
      data.assertions.push_back({.what = "share of " + named.name + " that 48 px read",
                                 .value = series.points[0].y,
                                 .bound = 0.3});
    data.series.push_back(std::move(series));
  }
  data.settings = {{"samples", "4"}, {"most anisotropy", "8"}};
  return data;
}

const Registration scenes_chart = register_chart({
    .name = "texture/levels_scenes",
    .title = "Share of scenes' textures that is made for a picture",
    .x = {.label = "width of the picture", .unit = "px", .logarithmic = true},
    .y = {.label = "bytes of the levels that are read, of all"},
    .produce = shares_of_scenes,
});

const Registration bytes_chart = register_chart({
    .name = "texture/levels_bytes",
    .title = "Memory of a renderer that makes only the texture levels that are read",
    .x = {.label = "distance", .unit = "m"},
    .y = {.label = "memory on the device", .unit = "byte"},
    .produce = [](gpu::Context& context) { return costs(context, false); },
});

const Registration time_chart = register_chart({
    .name = "texture/levels_time",
    .title = "Time to the first picture, with all texture levels or those that are read",
    .x = {.label = "distance", .unit = "m"},
    .y = {.label = "time", .unit = "ms"},
    .produce = [](gpu::Context& context) { return costs(context, true); },
});

}  // namespace
}  // namespace parity
