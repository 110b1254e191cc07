// Adaptive antialiasing: what is refined is the mean of 16 places, what is not follows from the
// middles around it.
#include "gpu/sampling/antialias.h"

#include <random>

#include "geometry/jitter.h"
#include "gpu/raster/renderer.h"
#include "tests/gpu_context.h"
#include "tests/small_scene.h"

namespace parity {
namespace {

constexpr float refine_all = -1, refine_none = 2;
/// Stored as half, rounded to either side; shading in float.
constexpr double half_step = 0x1p-11;

/// Triangles of one colour each: opaque ones that cross each other, one of a mask, two of glass.
SmallScene flat_triangles() {
  SmallScene scene;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(-1.1f, 1.1f), depth(-2.4f, -0.6f), shade(0, 1);
  for (int i = 0; i < 24; ++i) {
    Material material = unlit({shade(random), shade(random), shade(random), 1});
    if (i % 8 == 7) material.base_color.w = 0.4f;
    if (i == 3) material.alpha_mode = AlphaMode::mask;
    if (i == 7 || i == 15) material.alpha_mode = AlphaMode::blend;
    material.double_sided = true;
    Primitive p;
    p.material = scene.add_material(material);
    for (int k = 0; k < 3; ++k)
      p.positions.emplace_back(place(random), place(random), depth(random));
    p.normals.assign(3, vec3(0, 0, 1));
    p.indices = {0, 1, 2};
    scene.add(p);
  }
  return scene;
}

/// A square whose colour grows linearly over the screen.
SmallScene ramp() {
  SmallScene scene;
  Primitive p = quad(scene.add_material(unlit({1, 1, 1, 1})));
  p.colors = {
      {0.1f, 0.2f, 0.3f, 1}, {0.5f, 0.2f, 0.4f, 1}, {0.5f, 0.8f, 0.6f, 1}, {0.1f, 0.8f, 0.5f, 1}};
  scene.add(p);
  return scene;
}

/// The mean over the 16 places (4i + j, 4j + i), a place in each column and row of sixteenths.
Grid<dvec4> mean_of_16(const SmallScene& scene, const Frame& frame) {
  Grid<dvec4> mean(frame.options.width, frame.options.height);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const dvec2 place = (dvec2(4 * i + j, 4 * j + i) - 7.5) / 16.0;
      const Picture picture = cpu::render(scene.scene, shifted(frame, -place)).picture;
      for (std::size_t p = 0; p < mean.size(); ++p)
        mean.values()[p] += dvec4(picture.color.values()[p]) / 16.0;
    }
  return mean;
}

void expect_colors(const Grid<vec4>& got, const Grid<dvec4>& want, double tolerance) {
  for (int y = 0; y < want.height(); ++y)
    for (int x = 0; x < want.width(); ++x) {
      SCOPED_TRACE(std::to_string(x) + ", " + std::to_string(y));
      expect_color(got(x, y), want(x, y), tolerance);
    }
}

TEST(AdaptiveAntialiasing, RefinesToTheMeanOfSixteenPlaces) {
  if (!gpu::can_render(test_context().info())) GTEST_SKIP() << "skipped: the device cannot render";
  for (const DepthMode depth : {DepthMode::reverse_z, DepthMode::standard}) {
    const SmallScene scene = flat_triangles();
    const Frame frame = scene.frame(21, 1, depth);
    gpu::Antialiaser antialiaser(test_context(), scene.scene);
    const Picture got = antialiaser.adaptive(frame, refine_all, 1);
    EXPECT_EQ(antialiaser.refined(), 1);
    expect_colors(got.color, mean_of_16(scene, frame), half_step);
  }
}

/// The places at which shades are taken have the pixel's middle as their mean.
TEST(AdaptiveAntialiasing, LeavesALinearColourAsItIs) {
  if (!gpu::can_render(test_context().info())) GTEST_SKIP() << "skipped: the device cannot render";
  const SmallScene scene = ramp();
  const Frame frame = scene.frame(16);
  gpu::Antialiaser antialiaser(test_context(), scene.scene);
  const Grid<vec4> plain = gpu::render(test_context(), scene.scene, frame).color;
  for (const float contrast : {refine_all, refine_none}) {
    const Grid<vec4> got = antialiaser.adaptive(frame, contrast, 1).color;
    for (int y = 1; y < 15; ++y)
      for (int x = 1; x < 15; ++x) expect_color(got(x, y), dvec4(plain(x, y)), 2 * half_step);
  }
}

TEST(AdaptiveAntialiasing, TakesTheMeanOfSmoothPixelsFromThoseAround) {
  if (!gpu::can_render(test_context().info())) GTEST_SKIP() << "skipped: the device cannot render";
  const SmallScene scene = flat_triangles();
  const Frame frame = scene.frame(19);
  gpu::Antialiaser antialiaser(test_context(), scene.scene);
  const Grid<vec4> got = antialiaser.adaptive(frame, refine_none, 1).color;
  EXPECT_EQ(antialiaser.refined(), 0);
  const Grid<vec4> plain = gpu::render(test_context(), scene.scene, frame).color;
  const auto at = [&](int x, int y) {
    return dvec4(plain(std::clamp(x, 0, 18), std::clamp(y, 0, 18)));
  };
  Grid<dvec4> want(19, 19);
  for (int y = 0; y < 19; ++y)
    for (int x = 0; x < 19; ++x)
      want(x, y) =
          at(x, y) * (5.0 / 6) + (at(x - 1, y) + at(x + 1, y) + at(x, y - 1) + at(x, y + 1)) / 24.0;
  expect_colors(got, want, half_step);
}

TEST(AdaptiveAntialiasing, RefinesWhatDiffersOnTheScreenFromAPixelAround) {
  if (!gpu::can_render(test_context().info())) GTEST_SKIP() << "skipped: the device cannot render";
  // A square of half the picture's side in its middle: 2 pixels at either side of its edge differ.
  SmallScene scene;
  scene.add(quad(scene.add_material(unlit({0.25f, 0.25f, 0.25f, 1})), -1, 0.5f));
  Frame frame = scene.frame(16);
  frame.options.background = {0, 0, 0, 1};
  gpu::Antialiaser antialiaser(test_context(), scene.scene);
  antialiaser.adaptive(frame, 0.49f, 1);  // gamma 2 shows a quarter as a half
  EXPECT_EQ(antialiaser.refined(), (10 * 10 - 6 * 6) / 256.0);
  antialiaser.adaptive(frame, 0.51f, 1);
  EXPECT_EQ(antialiaser.refined(), 0);
  antialiaser.adaptive(frame, 0.51f, 2);  // twice as bright
  EXPECT_EQ(antialiaser.refined(), (10 * 10 - 6 * 6) / 256.0);
}

}  // namespace
}  // namespace parity
