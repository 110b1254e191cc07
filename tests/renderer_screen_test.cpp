#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "cpu_reference/raster/renderer.h"
#include "cpu_reference/shading/ambient_occlusion.h"
#include "geometry/ambient_occlusion.h"
#include "geometry/opaque_frame.h"
#include "geometry/scene_io.h"
#include "gpu/shading/ambient_occlusion.h"
#include "tests/raster/agreement.h"
#include "tests/renderer_scene.h"

/// What pictures that are made before say about places of the picture: ambient occlusion, and what
/// is seen through glass.
namespace parity {
namespace {

/// A wall at z = -2, red on the left, green on the right, behind a square of glass at z = 0.
struct Window {
  TestScene stage;

  Window(float thickness, float index) {
    stage.add_unlit(vec4(1, 0, 0, 1));
    stage.add_unlit(vec4(0, 1, 0, 1));
    Material& glass = stage.add_material();
    glass.metallic = 0;
    glass.roughness = 0;
    glass.ior = index;
    glass.transmission.factor = 1;
    glass.transmission.thickness = thickness;
    for (int half = 0; half < 2; ++half) {
      Primitive wall = square(4, -2, half);
      for (vec3& p : wall.positions) p.x += half == 0 ? -3.5f : 4.5f;  // they meet at x = 0.5
      stage.add(wall);
    }
    stage.add(square(3, 0, 2));
    stage.options.width = stage.options.height = 129;
    stage.options.environment = vec3(0);
    stage.options.key_light = false;
  }

  Frame frame() const {
    Frame frame = stage.frame();
    frame.behind = look_behind(stage.scene, frame, [&](const Frame& opaque) {
      return cpu::render(stage.scene, opaque).picture.color;
    });
    return frame;
  }
};

/// Where red turns green in the middle row, 0 to 1.
double border(const Grid<vec4>& color) {
  const int y = color.height() / 2;
  for (int x = 1; x < color.width(); ++x) {
    const double before = double(color(x - 1, y).x - color(x - 1, y).y);
    const double here = double(color(x, y).x - color(x, y).y);
    if (before > 0 && here <= 0)
      return (x - 0.5 + before / (before - here)) / double(color.width());
  }
  return -1;
}

TEST_F(GpuRenderer, GlassShowsWhereTheRefractedRayLeaves) {
  for (const float index : {1.0f, 1.5f})
    for (const float thickness : {0.0f, 1.5f}) {
      const Window window(thickness, index);
      const Frame frame = window.frame();
      // The eye is at z = 5; at z = -2 the border is at x = 0.5, and in the picture at 2.5 / 7 of
      // the way from the middle to the side. A ray through x at z = 0 leaves at x + t tan b, z =
      // -t.
      double low = 0, high = 1;
      for (int i = 0; i < 60; ++i) {
        const double x = (low + high) / 2, sine = std::sin(std::atan(x / 5)) / index;
        const double deep = thickness > 0 ? thickness * std::sqrt(1 - sine * sine) : 0;
        const double seen = (x + (thickness > 0 ? thickness * sine : 0)) / (5 + deep) * 5;
        (seen < 2.5 / 7 ? low : high) = x;
      }
      // The picture of the wall knows its border to half a pixel, seen under less than its scale.
      for (const Grid<vec4>& color :
           {gpu::render(test_context(), window.stage.scene, frame, {.full_float = true}).color,
            cpu::render(window.stage.scene, frame).picture.color})
        EXPECT_NEAR(border(color), 0.5 + low / 2, 1.0 / 129) << index << ", " << thickness;
    }
}

TEST_F(GpuRenderer, RoughGlassShowsTheMeanOfWhatIsBehind) {
  Window window(1, 2);  // such an index counts roughness in full
  window.stage.scene.materials[2].roughness = 1;
  const Frame frame = window.frame();
  const std::vector<Grid<vec4>>& levels = frame.behind->levels;
  ASSERT_EQ(levels.size(), 8u);
  const vec4 mean = levels.back()(0, 0);
  EXPECT_NEAR(mean.y, 0.5 - 2.5 / 7 / 2, 0.01);
  const vec4 got = middle(gpu::render(test_context(), window.stage.scene, frame));
  EXPECT_NEAR(got.x / got.y, mean.x / mean.y, 0.01);
}

TEST_F(GpuRenderer, GlassIsAsThickAsItsObjectIsLarge) {
  const auto shown = [](float thickness, double scale) {
    Window window(thickness, 1.5f);
    window.stage.scene.materials[2].transmission.attenuation_color = vec3(0.2f, 0.5f, 0.9f);
    window.stage.scene.materials[2].transmission.attenuation_distance = 1;
    window.stage.scene.nodes.back().parent_from_node = dmat4(
        dvec4(scale, 0, 0, 0), dvec4(0, scale, 0, 0), dvec4(0, 0, scale, 0), dvec4(0, 0, 0, 1));
    return middle(
        gpu::render(test_context(), window.stage.scene, window.frame(), {.full_float = true}));
  };
  const vec4 twice = shown(0.5f, 2), thick = shown(1, 1), thin = shown(0.5f, 1);
  expect_near(twice, thick, shading_tolerance);
  EXPECT_LT(thick.x, 0.7f * thin.x);
}

TEST(PictureLevels, KeepTheMeanOfAnySize) {
  for (const ivec2 size : {ivec2(7, 5), ivec2(16, 4), ivec2(1, 9), ivec2(131, 33)}) {
    Grid<vec4> picture{size.x, size.y};
    double sum = 0;
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) {
        picture(x, y) = vec4(float(x * x + 3 * y), 1, 0, 1);
        sum += x * x + 3 * y;
      }
    const std::vector<Grid<vec4>> levels = picture_levels(picture);
    EXPECT_EQ(levels.back().size(), 1u);
    const double mean = sum / double(picture.size());
    EXPECT_NEAR(levels.back()(0, 0).x, mean, mean * 1e-6 * double(levels.size()));
    EXPECT_NEAR(levels.back()(0, 0).w, 1, 1e-6);
  }
}

TEST(LookBehind, DrawsNothingWhereNothingTransmits) {
  const Scene scene = load_scene(std::filesystem::path(PARITY_SOURCE_DIR) / "assets/demo.glb");
  const Frame frame = make_frame(scene, {.width = 9, .height = 9});
  EXPECT_FALSE(look_behind(scene, frame, {}));
}

/// The demo scene in an even light, with the openness of its places.
struct ShadedDemo {
  Scene scene = load_scene(std::filesystem::path(PARITY_SOURCE_DIR) / "assets/demo.glb");
  Frame frame = make_frame(scene, {.width = 149, .height = 101, .environment = vec3(1)});
};

Grid<float> openness_of_host(const Scene& scene, const Frame& frame) {
  const Grid<double> open =
      cpu::ambient_occlusion(occlusion_problem(scene, frame, {}, [&](const Frame& opaque) {
        return cpu::render(scene, opaque, {.colors = false}).picture.depth;
      }));
  Grid<float> result(open.width(), open.height());
  std::copy(open.begin(), open.end(), result.begin());
  return result;
}

Grid<float> openness_of_device(const Scene& scene, const Frame& frame) {
  gpu::Renderer renderer(test_context(), scene);
  return gpu::ambient_occlusion(test_context(),
                                occlusion_problem(scene, frame, {}, [&](const Frame& opaque) {
                                  return renderer.render(opaque).depth;
                                }));
}

TEST_F(GpuRenderer, AmbientOcclusionIsThatOfTheReference) {
  ShadedDemo demo;
  const Grid<float> device = openness_of_device(demo.scene, demo.frame);
  const Grid<float> host = openness_of_host(demo.scene, demo.frame);
  int apart = 0, dark = 0;
  for (std::size_t i = 0; i < host.size(); ++i) {
    // Which triangle a pixel at a border shows may change, and with it what its neighbours see.
    apart += std::abs(device.values()[i] - host.values()[i]) > 2e-3f;
    dark += host.values()[i] < 0.8f;
  }
  EXPECT_LE(apart, int(host.size()) / 200);
  EXPECT_GT(dark, 100);
  demo.frame.openness = device;
  const raster_test::Agreement agreement =
      raster_test::draw_and_compare(test_context(), demo.scene, demo.frame);
  EXPECT_EQ(agreement.wrong(), 0u) << agreement.text();
  const auto shown = [&](gpu::RenderOptions options) {
    return gpu::render(test_context(), demo.scene, demo.frame, options).color;
  };
  EXPECT_EQ(shown({}), shown({.general = true}));
}

TEST_F(GpuRenderer, OpennessScalesOnlyLightFromAllAround) {
  TestScene stage;
  Material& white = stage.add_material();
  white.metallic = 0;
  white.specular.strength = 0;  // no mirror
  stage.add(square(3, 0));
  stage.add_light(directional(1));
  stage.options.environment = vec3(1);
  Frame frame = stage.frame();
  const auto shown = [&](const Frame& f) {
    const Picture device = gpu::render(test_context(), stage.scene, f, {.full_float = true});
    const vec4 host = middle(cpu::render(stage.scene, f).picture);
    expect_near(middle(device), host, 4 * shading_tolerance);
    return double(host.x);
  };
  const double all = shown(frame);
  frame.openness = Grid<float>{5, 3, 0.25f};  // of any size
  const double quarter = shown(frame);
  frame.lights.clear();
  const double quarter_alone = shown(frame);
  frame.openness = {};
  const double alone = shown(frame);
  EXPECT_NEAR(quarter_alone, alone / 4, 1e-6);
  EXPECT_NEAR(all - quarter, 0.75 * alone, 1e-6);
}

}  // namespace
}  // namespace parity
