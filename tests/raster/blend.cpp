#include "cpu_reference/raster/blend.h"

#include "geometry/random.h"
#include "gpu/raster/blend.h"
#include "tests/stage.h"

namespace parity {
namespace {

struct Layers {
  std::vector<Grid<vec4>> layers;
  BlendMode mode = BlendMode::over;
};
auto fields_of(const Layers*) { return std::tuple{&Layers::layers, &Layers::mode}; }

Layers random_layers(const Setting& setting) {
  Random random{setting.seed};
  Layers p;
  p.mode = BlendMode(setting.count("mode"));
  for (int k = 0; k < setting.count("layers"); ++k) {
    Grid<vec4> layer{setting.count("side"), 17};
    for (vec4& c : layer) {
      const float alpha = random.uniform();
      const vec3 color{random.uniform(), random.uniform(), random.uniform()};
      // Sums stay within what the 8-bit target holds.
      c = p.mode == BlendMode::add ? vec4(color, alpha) / float(setting.count("layers"))
                                   : vec4(p.mode == BlendMode::over ? color : color * alpha, alpha);
    }
    p.layers.push_back(layer);
  }
  return p;
}

double distance(const Grid<dvec4>& got, const Grid<dvec4>& want) {
  double worst = 0;
  for (std::size_t i = 0; i < want.size(); ++i) {
    const dvec4 apart = glm::abs(got.values()[i] - want.values()[i]);
    worst = std::max({worst, apart.x, apart.y, apart.z, apart.w});
  }
  return worst;
}

Grid<dvec4> widened(const Grid<vec4>& values) {
  Grid<dvec4> result{values.width(), values.height()};
  std::copy(values.begin(), values.end(), result.begin());
  return result;
}

const std::vector<Axis> axes{
    {.name = "mode", .low = 0, .high = 2, .standard = 0, .whole = true, .each = true},
    {.name = "layers", .low = 1, .high = 16, .standard = 4, .logarithmic = true, .whole = true},
    {.name = "side", .unit = "px", .low = 1, .high = 131, .standard = 64, .whole = true}};

const Registration in_floats = register_stage<Layers, Grid<dvec4>>({
    .name = "raster/blend",
    .title = "Layers over one another in 32-bit floats",
    .source = "notes 1.7; Porter & Duff 1984; Vulkan 1.3, Blending",
    .rows = {13},
    .axes = axes,
    .problem = random_layers,
    .cpu = {{.solve = [](const Layers& p) { return cpu::blend(p.layers, p.mode); }}},
    .gpu = {{.name = "compute",
             .solve =
                 [](gpu::Context& context, const Layers& p) {
                   return widened(gpu::blend(context, p.layers, p.mode));
                 }},
            {.name = "hardware",
             .solve =
                 [](gpu::Context& context, const Layers& p) {
                   return widened(
                       gpu::hardware_blend(context, p.layers, p.mode, gpu::Format::rgba32_float));
                 }}},
    .distance = distance,
    .tolerance = [](const Layers& p) { return 4.0 * double(p.layers.size()) * 0x1p-24; },
    .why = "each layer: 1 - a, two products, a sum, of values up to 1: 4 u; what is below shrinks "
           "by 1 - a",
});

const Registration in_bytes = register_stage<Layers, Grid<dvec4>>({
    .name = "raster/blend_unorm8",
    .title = "Layers over one another on an 8-bit target",
    .source = "notes 1.7; Porter & Duff 1984; Vulkan 1.3, Blending",
    .rows = {13},
    .axes = axes,
    .problem = random_layers,
    .cpu = {{.solve = [](const Layers& p) { return cpu::blend_unorm8(p.layers, p.mode); }}},
    .gpu = {{.name = "hardware",
             .solve =
                 [](gpu::Context& context, const Layers& p) {
                   return widened(
                       gpu::hardware_blend(context, p.layers, p.mode, gpu::Format::rgba8));
                 }}},
    .distance = distance,
    .tolerance = [](const Layers& p) { return 2.0 * double(p.layers.size()) / 255; },
    .why = "Vulkan asks for the target's precision only: a driver may round the source to 8 bits "
           "first (half a "
           "step) and the result by one step either way: 2 steps a layer",
});

}  // namespace
}  // namespace parity
