#include <gtest/gtest.h>

#include <cmath>

#include "cpu_reference/fluid/draw_field.h"
#include "cpu_reference/fluid/draw_scene.h"
#include "gpu/fluid/draw_field.h"
#include "gpu/fluid/draw_scene.h"
#include "tests/gpu_context.h"

namespace parity {
namespace {

Grid<dvec4> widened(const Grid<vec4>& picture) {
  Grid<dvec4> result{picture.width(), picture.height()};
  for (std::size_t i = 0; i < picture.size(); ++i) result.values()[i] = dvec4(picture.values()[i]);
  return result;
}

/// A scene without floor, solids and light but the sky's.
DrawnScene bare_scene() {
  DrawnScene scene;
  scene.view = flat_view({9, 9}, {0, 0}, {1, 1});
  scene.light.has_floor = 0;
  scene.light.sun_color = vec3(0);
  scene.light.sky_color = scene.light.ground_color = vec3(1);
  scene.light.horizon = vec3(0.25f);
  return scene;
}

using Draw = std::function<Grid<dvec4>(const DrawnScene&)>;
const std::vector<Draw>& both() {
  static const std::vector<Draw> sides{
      [](const DrawnScene& s) { return cpu::draw_scene(s); },
      [](const DrawnScene& s) { return widened(gpu::draw_scene(test_context(), s)); }};
  return sides;
}

TEST(DrawScene, NothingShowsTheHorizon) {
  for (const Draw& draw : both())
    for (const dvec4& pixel : draw(bare_scene())) EXPECT_EQ(pixel, dvec4(0.25, 0.25, 0.25, 1));
}

TEST(DrawScene, ABallInEvenLightHasItsOwnColor) {
  DrawnScene scene = bare_scene();
  scene.positions = {{0.5f, 0.5f, 0}, {0.5f, 0.5f, -0.5f}};
  scene.colors = {{0.5f, 0.25f, 0.75f}, vec3(0)};
  scene.radius = 0.2f;
  for (const Draw& draw : both()) {
    const Grid<dvec4> picture = draw(scene);
    EXPECT_LT(glm::length(dvec3(picture(4, 4)) - dvec3(0.5, 0.25, 0.75)), 1e-6);
    EXPECT_EQ(picture(0, 0), dvec4(0.25, 0.25, 0.25, 1));
  }
}

TEST(DrawScene, EvenSmokeDimsByBeerAndLambert) {
  DrawnScene scene = bare_scene();
  scene.light.sky_color = scene.light.ground_color = vec3(0);  // it scatters nothing
  scene.volume = {.mode = VolumeMode::smoke, .size = {4, 4, 6}, .origin = vec3(0), .cell = 0.25f};
  scene.volume.values.assign(4 * 4 * 6, 0.8f);
  const double passes = std::exp(-0.8 * 1.5);  // six cells deep
  for (const Draw& draw : both())
    EXPECT_NEAR(draw(scene)(4, 4).x, 0.25 * passes, 1e-5);  // 60 steps of 2^-24
}

TEST(DrawScene, TheSunBehindASolidLeavesTheFloorInShadow) {
  DrawnScene scene = bare_scene();
  scene.view = perspective_view({9, 9}, {0.5, 4, 0.5001}, {0.5, 0, 0.5}, 20);
  scene.light.has_floor = 1;
  scene.light.fade = 1e6f;
  scene.light.sky_color = scene.light.ground_color = vec3(0);
  scene.light.sun_color = vec3(1);
  scene.light.sun = vec3(0, 1, 0);
  scene.light.floor_color = vec3(0.5f);
  for (const Draw& draw : both()) {
    scene.solids.clear();
    EXPECT_NEAR(draw(scene)(4, 4).x, 0.5, 1e-6);
    scene.solids = {{.is_box = 0, .low = vec3(0.5f, 6, 0.5f), .high = vec3(0.5f)}};
    EXPECT_NEAR(draw(scene)(4, 4).x, 0, 1e-6);
    scene.solids[0].casts_shadow = 0;
    EXPECT_NEAR(draw(scene)(4, 4).x, 0.5, 1e-6);
  }
}

/// Flow to the right everywhere over noise of rows 0 and 1 by turns, without colours.
DrawnField even_flow() {
  DrawnField field{.cells = {4, 4}, .streak = 8, .contrast = 1, .width = 32, .height = 32};
  field.velocity.assign(16, vec2(1, 0));
  field.value.assign(16, 0.5f);
  field.solid.assign(16, 0.0f);
  field.color_map = {vec3(0), vec3(1)};
  field.noise = Grid<float>(8, 8);
  field.noise_scale = 1;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) field.noise(x, y) = y % 2 == 0 ? 0.45f : 0.55f;
  return field;
}

TEST(DrawField, StreaksRunAlongTheFlow) {
  for (const bool on_device : {false, true}) {
    const DrawnField field = even_flow();
    const Grid<dvec4> picture =
        on_device ? widened(gpu::draw_field(test_context(), field)) : cpu::draw_field(field);
    const double gain = 1.5 * std::sqrt(8.0) / (1 + 1e-3);  // rows of noise stay as they are
    for (int x = 0; x < 32; ++x) {
      EXPECT_NEAR(picture(x, 10).x, 0.5 * (1 - 0.05 * gain), 1e-5);
      EXPECT_NEAR(picture(x, 11).x, 0.5 * (1 + 0.05 * gain), 1e-5);
    }
  }
}

TEST(DrawField, RefusesAPictureOfNothing) {
  DrawnField field = even_flow();
  field.value.pop_back();
  EXPECT_THROW(cpu::draw_field(field), std::invalid_argument);
  EXPECT_THROW(gpu::draw_field(test_context(), field), std::invalid_argument);
}

TEST(DrawScene, RefusesWhatItCannotDraw) {
  DrawnScene scene = bare_scene();
  scene.colors.resize(1);
  EXPECT_THROW(cpu::draw_scene(scene), std::invalid_argument);
  EXPECT_THROW(gpu::draw_scene(test_context(), scene), std::invalid_argument);
  scene = bare_scene();
  scene.volume = {.mode = VolumeMode::smoke, .size = {2, 2, 2}, .values = {1}};
  EXPECT_THROW(cpu::draw_scene(scene), std::invalid_argument);
  scene = bare_scene();
  scene.view.width = 0;
  EXPECT_THROW(gpu::draw_scene(test_context(), scene), std::invalid_argument);
}

}  // namespace
}  // namespace parity
