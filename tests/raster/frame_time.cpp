#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "cpu_reference/raster/renderer.h"
#include "geometry/mesh_io.h"
#include "geometry/scene_from_mesh.h"
#include "gpu/raster/bare_draw.h"
#include "gpu/raster/renderer.h"
#include "tests/chart.h"
#include "tests/shared_data.h"
#include "tests/statistics.h"

/// What the renderer costs beside a bare draw, and the reference beside the device.
namespace parity {
namespace {

/// A unit sphere of 2 * `rings` * (2 * `rings`) triangles, poles included.
Primitive sphere(int rings) {
  Primitive p;
  for (int j = 0; j <= rings; ++j)
    for (int i = 0; i <= 2 * rings; ++i) {
      const double theta = M_PI * j / rings, phi = M_PI * i / rings;
      p.normals.emplace_back(
          dvec3(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi)));
    }
  p.positions = p.normals;
  for (int j = 0; j < rings; ++j)
    for (int i = 0; i < 2 * rings; ++i) {
      const auto a = std::uint32_t(j * (2 * rings + 1) + i);
      const auto below = a + std::uint32_t(2 * rings) + 1;
      for (const std::uint32_t v : {a, below, below + 1, a, below + 1, a + 1})
        p.indices.push_back(v);
    }
  return p;
}

/// The mesh in white under one light: what BareDraw shows.
Scene lit_scene(Primitive primitive) {
  Scene scene;
  scene.materials.push_back({.metallic = 0.0f, .roughness = 0.5f});
  primitive.material = 0;
  scene.meshes.push_back({"mesh", {std::move(primitive)}});
  scene.lights.push_back({.kind = LightKind::directional, .intensity = 2.0f});
  Node mesh, light;
  mesh.mesh = 0;
  light.light = 0;
  scene.nodes = {mesh, light};
  return scene;
}

/// The bust of 70,000 triangles where the shared data is at hand.
std::optional<Primitive> bust() {
  const auto file = shared_data("data/mesh/nefertiti_70k.obj");
  if (!file) return std::nullopt;
  Primitive p = scene_from_mesh(load_mesh(*file), "bust", std::nullopt).meshes[0].primitives[0];
  p.uvs.clear();
  p.colors.clear();
  return p;
}

Frame frame_of(const Scene& scene, int width, int height) {
  return make_frame(scene, {.width = width, .height = height, .environment = vec3(0.3f)});
}

struct Costs {
  double bare_ms = 0;  ///< medians
  double renderer_ms = 0;
  double general_ms = 0;  ///< the renderer with nothing left out of its shaders
  double ratio = 0;       ///< median of the ratios of neighbours in time
  double difference = 0;  ///< largest, of any channel of any pixel
};

/// Device milliseconds of both by turns, reading back the picture included.
Costs measure(gpu::Context& context, const Primitive& primitive) {
  const Scene scene = lit_scene(primitive);
  const Frame frame = frame_of(scene, 1920, 1080);
  gpu::Renderer renderer(context, scene);
  gpu::Renderer general(context, scene, {.general = true});
  gpu::BareDraw bare(context, primitive, frame.options.width, frame.options.height);
  std::vector<double> bare_ms, renderer_ms, general_ms, ratios;
  Costs costs;
  for (int repetition = -1; repetition < 15; ++repetition) {
    const double bare_now = 1e3 * bare.draw(frame, scene.materials[0]).seconds;
    const double start = context.device_seconds();
    const Picture picture = renderer.render(frame);
    const double renderer_now = 1e3 * (context.device_seconds() - start);
    const double general_start = context.device_seconds();
    general.render(frame);
    const double general_now = 1e3 * (context.device_seconds() - general_start);
    if (repetition < 0) {
      const Grid<vec4> want = bare.picture();
      for (std::size_t i = 0; i < want.values().size(); ++i)
        for (int c = 0; c < 3; ++c)
          costs.difference =
              std::max(costs.difference,
                       double(std::abs(want.values()[i][c] - picture.color.values()[i][c])));
      continue;
    }
    bare_ms.push_back(bare_now);
    renderer_ms.push_back(renderer_now);
    general_ms.push_back(general_now);
    ratios.push_back(renderer_now / bare_now);
  }
  costs.bare_ms = median(bare_ms);
  costs.renderer_ms = median(renderer_ms);
  costs.general_ms = median(general_ms);
  costs.ratio = median(ratios);
  return costs;
}

ChartData renderer_and_bare_draw(gpu::Context& context) {
  Series bare{"device, bare draw", {}}, renderer{"device, renderer", {}},
      general{"device, renderer that leaves nothing out", {}};
  ChartData data;
  double difference = 0;
  // Both shade in float and store halves: two ulps of a half below 4.
  constexpr double same = 2 * 0x1p-9;
  const auto add = [&](const Primitive& primitive, const std::string& name) {
    const Costs costs = measure(context, primitive);
    const double triangles = double(primitive.indices.size() / 3);
    bare.points.push_back({triangles, costs.bare_ms, name});
    renderer.points.push_back({triangles, costs.renderer_ms, name});
    general.points.push_back({triangles, costs.general_ms, name});
    difference = std::max(difference, costs.difference);
    return costs;
  };
  for (const int rings : {16, 32, 66}) add(sphere(rings), "sphere");
  data.assertions.push_back({"sphere of 70,000 triangles: time over that of a bare draw",
                             add(sphere(132), "sphere").ratio, 1.25});
  for (const int rings : {264, 512}) add(sphere(rings), "sphere");
  data.series = {bare, renderer, general};
  if (const std::optional<Primitive> mesh = bust()) {
    bare = {"device, bare draw of a bust", {}};
    renderer = {"device, renderer, bust", {}};
    data.assertions.push_back({"bust of 70,000 triangles: time over that of a bare draw",
                               add(*mesh, "bust").ratio, 1.25});
    data.series.insert(data.series.end(), {bare, renderer});
  }
  data.assertions.push_back({"largest difference of the pictures", difference, same});
  data.settings = {{"picture", "1920 x 1080, RGBA16F and D32F"},
                   {"timed",
                    "the device by its own clock, from clearing to the picture in a "
                    "buffer; medians of 15 by turns"}};
  return data;
}

const Registration renderer_chart = register_chart({
    .name = "raster/frame_time",
    .title = "A lit frame by the renderer and by a bare draw of the same triangles",
    .x = {.label = "triangles"},
    .y = {.label = "time", .unit = "ms"},
    .produce = renderer_and_bare_draw,
});

/// Runs with one thread on either side: the drivers of Mesa read the variable when an instance is
/// made; 0 lets the one thread that takes the commands do everything.
template <typename F>
void with_one_thread(const F& function) {
  const char* old = std::getenv("LP_NUM_THREADS");
  const std::string kept = old == nullptr ? "" : old;
  const int threads = omp_get_max_threads();
  setenv("LP_NUM_THREADS", "0", 1);
  omp_set_num_threads(1);
  const auto restore = [&] {
    omp_set_num_threads(threads);
    old == nullptr ? unsetenv("LP_NUM_THREADS") : setenv("LP_NUM_THREADS", kept.c_str(), 1);
  };
  try {
    function();
  } catch (...) {
    restore();
    throw;
  }
  restore();
}

ChartData reference_and_device(gpu::Context& outer) {
  Series reference{"cpu reference", {}}, device{"device, renderer", {}};
  std::vector<double> ratios;
  with_one_thread([&] {
    gpu::Context context({.device = std::to_string(outer.info().index)});
    for (const int rings : {16, 32, 66, 132, 264}) {
      const Scene scene = lit_scene(sphere(rings));
      const Frame frame = frame_of(scene, 1920, 1080);
      gpu::Renderer renderer(context, scene);
      renderer.render(frame);
      std::vector<double> cpu_ms, device_ms;
      for (int repetition = 0; repetition < 3; ++repetition) {
        const double device_start = context.device_seconds();
        renderer.render(frame);
        device_ms.push_back(1e3 * (context.device_seconds() - device_start));
        const double start = detail::wall_seconds();
        cpu::render(scene, frame);
        cpu_ms.push_back(1e3 * (detail::wall_seconds() - start));
      }
      const double triangles = 4.0 * rings * rings;
      reference.points.push_back({triangles, median(cpu_ms), "sphere"});
      device.points.push_back({triangles, median(device_ms), "sphere"});
      ratios.push_back(median(cpu_ms) / median(device_ms));
    }
  });
  ChartData data{.series = {reference, device}};
  if (outer.info().is_mesa_software)
    data.assertions.push_back(
        {"70,000 triangles: reference over device, one thread each", ratios[3], 20});
  data.settings = {{"picture", "1920 x 1080"},
                   {"timed",
                    "the device by its own clock with one thread, the reference by the "
                    "wall with one thread; medians of 3 by turns"}};
  return data;
}

const Registration reference_chart = register_chart({
    .name = "raster/reference_time",
    .title = "A lit frame by the device and by the reference, one thread each",
    .x = {.label = "triangles"},
    .y = {.label = "time", .unit = "ms"},
    .produce = reference_and_device,
});

}  // namespace
}  // namespace parity
