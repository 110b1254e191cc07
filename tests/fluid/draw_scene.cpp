#include "gpu/fluid/draw_scene.h"

#include "cpu_reference/fluid/draw_scene.h"
#include "geometry/random.h"
#include "tests/stage.h"

namespace parity {

auto fields_of(const DrawnView*) {
  return std::tuple{&DrawnView::eye, &DrawnView::right, &DrawnView::up, &DrawnView::forward};
}
auto fields_of(const DrawnVolume*) {
  return std::tuple{&DrawnVolume::origin, &DrawnVolume::cell, &DrawnVolume::values};
}
auto fields_of(const DrawnScene*) {
  return std::tuple{&DrawnScene::view, &DrawnScene::positions, &DrawnScene::colors,
                    &DrawnScene::radius, &DrawnScene::volume};
}

namespace {

DrawnVolume blob(int cells, float extinction, VolumeMode mode, Random& random) {
  DrawnVolume volume{.mode = mode,
                     .size = {cells, cells + 3, std::max(cells - 2, 1)},
                     .origin = {0, 0, 0},
                     .cell = 1.0f / float(cells)};
  const vec3 middle = vec3(0.5f) + random.in_box(0.1f);
  for (int z = 0; z < volume.size.z; ++z)
    for (int y = 0; y < volume.size.y; ++y)
      for (int x = 0; x < volume.size.x; ++x) {
        const vec3 p = (vec3(x, y, z) + 0.5f) * volume.cell - middle;
        const float inside = std::max(0.0f, 0.16f - glm::dot(p, p)) / 0.16f;
        volume.values.push_back(extinction * inside * random.uniform(0.5f, 1.0f));
      }
  return volume;
}

DrawnScene empty_scene(const Setting& setting) {
  DrawnScene scene;
  const int side = setting.count("side");
  scene.view = setting.count("flat") != 0
                   ? flat_view({side, 33}, {0, 0}, {1, 1})
                   : perspective_view({side, 33}, {0.7, 1.1, 2.6}, {0.5, 0.4, 0.5}, 40);
  scene.view.samples = setting.count("samples");
  scene.light.sun = glm::normalize(vec3(0.4f, 0.8f, 0.3f));
  scene.light.fade = 8;
  scene.solids = {{.is_box = 0, .low = vec3(0.9f, 0.2f, 0.4f), .high = vec3(0.2f)},
                  {.is_box = 1, .low = vec3(0.1f, 0, 0.6f), .high = vec3(0.3f, 0.5f, 0.8f)},
                  {.is_box = 1, .casts_shadow = 0, .low = vec3(0), .high = vec3(1, 0.01f, 0.01f)}};
  return scene;
}

DrawnScene random_balls(const Setting& setting) {
  Random random{setting.seed};
  DrawnScene scene = empty_scene(setting);
  scene.radius = float(setting.at("radius"));
  const int count = setting.count("particles");
  for (int i = 0; i < count; ++i) {
    scene.positions.push_back(vec3(0.5f) + random.in_box(0.45f));
    scene.colors.push_back(vec3(0.5f) + random.in_box(0.4f));
  }
  scene.volume = blob(8, 4.0f, VolumeMode::shadow, random);
  return scene;
}

DrawnScene random_smoke(const Setting& setting) {
  Random random{setting.seed};
  DrawnScene scene = empty_scene(setting);
  scene.light.forward_scatter = 0.3f;
  scene.volume =
      blob(setting.count("cells"), float(setting.at("extinction")), VolumeMode::smoke, random);
  return scene;
}

/// How far each pixel may be off: float evaluation, and what the picture changes by when every ray
/// is moved by 1/500 of a sample, which is some hundred times what rounding moves it by. So a pixel
/// on an outline or a shadow's border may show either side, and no other may.
Grid<double> bounds(const DrawnScene& scene, const Grid<dvec4>& want) {
  constexpr double rounding = 0x1p-24 * 512;
  Grid<double> bound{want.width(), want.height(), rounding};
  const DrawnView& view = scene.view;
  const vec3 x = view.right * (0.004f / float(view.width * view.samples));
  const vec3 y = view.up * (0.004f / float(view.height * view.samples));
  for (const vec3& shift : {x + y, x - y, -x + y, -x - y}) {
    DrawnScene moved = scene;
    (view.is_orthographic ? moved.view.eye : moved.view.forward) += shift;
    const Grid<dvec4> picture = cpu::draw_scene(moved);
    for (std::size_t i = 0; i < want.size(); ++i) {
      const dvec3 change = glm::abs(dvec3(picture.values()[i] - want.values()[i]));
      bound.values()[i] += std::max({change.x, change.y, change.z});
    }
  }
  return bound;
}

double distance(const DrawnScene& scene, const Grid<dvec4>& got, const Grid<dvec4>& want) {
  const Grid<double> bound = bounds(scene, want);
  double worst = 0;
  for (std::size_t i = 0; i < want.size(); ++i) {
    const dvec4 apart = glm::abs(got.values()[i] - want.values()[i]);
    worst = std::max(worst, std::max({apart.x, apart.y, apart.z, apart.w}) / bound.values()[i]);
  }
  return worst;
}

Grid<dvec4> widened(const Grid<vec4>& picture) {
  Grid<dvec4> result{picture.width(), picture.height()};
  for (std::size_t i = 0; i < picture.size(); ++i) result.values()[i] = dvec4(picture.values()[i]);
  return result;
}

StageRecord<DrawnScene, Grid<dvec4>> record(const std::string& name, const std::string& title,
                                            std::vector<Axis> axes,
                                            MakeProblem<DrawnScene> problem) {
  axes.push_back(
      {.name = "side", .unit = "px", .low = 1, .high = 131, .standard = 48, .whole = true});
  axes.push_back({.name = "samples", .low = 1, .high = 3, .standard = 1, .whole = true});
  axes.push_back({.name = "flat", .low = 0, .high = 1, .standard = 0, .whole = true});
  return {
      .name = name,
      .title = title,
      .source = "notes 6.1, 7.2; Max 1995; Kunasz & Auer 1988",
      .rows = {168},
      .axes = std::move(axes),
      .problem = std::move(problem),
      .cpu = {{.solve = [](const DrawnScene& s) { return cpu::draw_scene(s); }}},
      .gpu = {{.solve = [](gpu::Context& context,
                           const DrawnScene& s) { return widened(gpu::draw_scene(context, s)); }}},
      .distance = distance,
      .tolerance = 1.0,
      .why =
          "in units of each pixel's own bound: 512 roundings of 2^-24 for up to 100 steps of "
          "marching with some five operations each, plus what the picture itself changes by "
          "when its rays move by 1/500 of a sample",
      .chart_axes = {"side"},
  };
}

const Registration balls = register_stage<DrawnScene, Grid<dvec4>>(
    record("fluid/draw_spheres", "Particles as shaded balls among solids on a floor",
           {{.name = "particles", .low = 0, .high = 500, .standard = 120, .whole = true},
            {.name = "radius", .unit = "m", .low = 0.01, .high = 0.3, .standard = 0.05}},
           random_balls));

const Registration smoke = register_stage<DrawnScene, Grid<dvec4>>(
    record("fluid/draw_smoke", "Smoke that scatters light once, with shadows",
           {{.name = "cells", .low = 1, .high = 40, .standard = 16, .whole = true},
            {.name = "extinction", .unit = "1/m", .low = 0, .high = 60, .standard = 8}},
           random_smoke));

}  // namespace
}  // namespace parity
