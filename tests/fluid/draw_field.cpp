#include "gpu/fluid/draw_field.h"

#include <algorithm>

#include "cpu_reference/fluid/draw_field.h"
#include "geometry/random.h"
#include "tests/stage.h"

namespace parity {

auto fields_of(const DrawnField*) {
  return std::tuple{&DrawnField::velocity, &DrawnField::value, &DrawnField::solid,
                    &DrawnField::color_map, &DrawnField::noise};
}

namespace {

/// A vortex with some disorder.
DrawnField random_flow(const Setting& setting) {
  Random random{setting.seed};
  DrawnField field;
  const int n = setting.count("cells");
  field.cells = {n, n + 2};
  for (int y = 0; y < field.cells.y; ++y)
    for (int x = 0; x < n; ++x) {
      const vec2 p = vec2(x, y) / float(n) - 0.5f;
      field.velocity.push_back(vec2(-p.y, p.x) + 0.1f * vec2(random.in_box(1.0f)));
      field.value.push_back(random.uniform(-0.1f, 1.1f));
      field.solid.push_back(random.below(9) == 0 ? 1.0f : 0.0f);
    }
  for (int i = 0; i < 5; ++i) field.color_map.push_back(vec3(0.5f) + random.in_box(0.5f));
  field.noise = Grid<float>(17, 13);
  for (float& v : field.noise) v = random.uniform();
  field.streak = setting.count("streak");
  field.slowest = 0.02f;
  field.width = setting.count("side");
  field.height = 33;
  return field;
}

Grid<dvec4> widened(const Grid<vec4>& picture) {
  Grid<dvec4> result{picture.width(), picture.height()};
  for (std::size_t i = 0; i < picture.size(); ++i) result.values()[i] = dvec4(picture.values()[i]);
  return result;
}

double distance(const Grid<dvec4>& got, const Grid<dvec4>& want) {
  double worst = 0;
  for (std::size_t i = 0; i < want.size(); ++i) {
    const dvec4 apart = glm::abs(got.values()[i] - want.values()[i]);
    worst = std::max({worst, apart.x, apart.y, apart.z, apart.w});
  }
  return worst;
}

/// A position on the screen is wrong by 4 roundings of its size at each step, and a wrong position
/// makes later steps wrong by the gradient of the direction, 1 / (cell in px x slowest / speed);
/// the noise turns that into brightness by 1 / noise_scale, and the streaks' gain makes it larger.
double tolerance(const DrawnField& field) {
  const double size = std::max(field.width, field.height);
  const double cell = std::max(1.0, size / std::max(field.cells.x, field.cells.y));
  const double steps = field.streak + 1, gain = 1.5 * std::sqrt(steps);
  const double off = 4 * 0x1p-24 * size * steps * std::exp(std::min(steps / cell, 8.0));
  return 32 * 0x1p-24 +
         (gain * double(field.contrast) / double(field.noise_scale) + 1 / cell) * 2 * off;
}

const Registration registration = register_stage<DrawnField, Grid<dvec4>>({
    .name = "fluid/draw_field",
    .title = "A flow in 2 dimensions: colours by value, streaks along streamlines",
    .source = "Cabral & Leedom 1993",
    .rows = {167},
    .axes = {{.name = "cells", .low = 1, .high = 64, .standard = 12, .whole = true},
             {.name = "streak", .unit = "px", .low = 0, .high = 40, .standard = 12, .whole = true},
             {.name = "side", .unit = "px", .low = 1, .high = 257, .standard = 64, .whole = true}},
    .problem = random_flow,
    .cpu = {{.solve = [](const DrawnField& f) { return cpu::draw_field(f); }}},
    .gpu = {{.solve = [](gpu::Context& context,
                         const DrawnField& f) { return widened(gpu::draw_field(context, f)); }}},
    .distance = distance,
    .tolerance = tolerance,
    .why = "4 roundings of a position a step, carried along the streamline with the growth of its "
           "direction's gradient, times the slopes of the noise and of the colours",
    .chart_axes = {"streak"},
});

}  // namespace
}  // namespace parity
