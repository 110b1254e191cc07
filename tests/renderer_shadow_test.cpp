#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "cpu_reference/raster/renderer.h"
#include "geometry/cast_shadows.h"
#include "geometry/scene_io.h"
#include "gpu/sampling/antialias.h"
#include "tests/raster/agreement.h"
#include "tests/renderer_scene.h"

/// Shadow maps in the renderers.
namespace parity {
namespace {

std::vector<LightShadow> cast_on_device(const Scene& scene, const Frame& frame,
                                        const ShadowOptions& options = {.side = 512}) {
  gpu::Renderer renderer(test_context(), scene);
  return cast_shadows(scene, frame, options,
                      [&](const Frame& map) { return renderer.render(map).depth; });
}

std::vector<LightShadow> cast_on_host(const Scene& scene, const Frame& frame,
                                      const ShadowOptions& options = {.side = 512}) {
  return cast_shadows(scene, frame, options, [&](const Frame& map) {
    return cpu::render(scene, map, {.colors = false}).picture.depth;
  });
}

constexpr double blocker_size = 0.3, blocker_height = 1;

/// A wall at z = 0 and a small square before it, under one light from the left.
struct Wall {
  TestScene stage;
  Frame frame;
  dvec3 light_position{-1, 0, 3};  // of a spot
  dvec3 direction = glm::normalize(dvec3(1, 0, -2));

  explicit Wall(LightKind kind) {
    stage.add_material().metallic = 0;
    stage.add(square(3, 0));
    stage.add(square(float(blocker_size), float(blocker_height)));
    Light light;
    light.kind = kind;
    light.intensity = 20;
    light.outer_cone_angle = 1;
    light.inner_cone_angle = 0.9f;
    stage.add_light(light);
    frame = stage.frame();
    frame.lights[0].direction =
        kind == LightKind::directional ? direction : glm::normalize(dvec3(1, 0, -3));
    frame.lights[0].position = light_position;
  }

  /// Where the ray to the light from a point of the wall meets the plane of the square.
  dvec2 toward_light(const dvec2& p) const {
    if (frame.lights[0].light.kind == LightKind::directional)
      return p - dvec2(direction) * (blocker_height / -direction.z);
    return p + (dvec2(light_position) - p) * (blocker_height / light_position.z);
  }
};

double beyond(const dvec2& p, double size) { return std::max(std::abs(p.x), std::abs(p.y)) - size; }

/// Compares with what geometry says, but for its border: r + 1 texels of filter and map, and
/// sqrt 2 (r + 1) by which a receiver is moved; in the plane of the square a texel is at most 0.015
/// m.
///
/// @param reach  of a pixel's places from its middle, m.
void expect_shadow(const Wall& wall, const Grid<vec4>& with, const Grid<vec4>& without,
                   double reach = 0) {
  int dark = 0, lit = 0;
  for (int y = 0; y < 33; ++y)
    for (int x = 0; x < 33; ++x) {
      const dvec2 p{(x + 0.5) / 33 * 2 - 1, 1 - (y + 0.5) / 33 * 2};
      if (beyond(p * 0.8, blocker_size) < 0.03 + reach) {  // the square itself
        if (beyond(p * 0.8, blocker_size) < -0.03 - reach) {
          EXPECT_EQ(with(x, y), without(x, y));
        }
        continue;
      }
      const double outside = beyond(wall.toward_light(p), blocker_size);
      if (std::abs(outside) < 0.075 + reach) continue;
      (outside < 0 ? dark : lit) += 1;
      EXPECT_EQ(with(x, y), outside < 0 ? vec4(0, 0, 0, 1) : without(x, y)) << x << ", " << y;
    }
  EXPECT_GT(dark, 20);
  EXPECT_GT(lit, 300);
}

TEST_F(GpuRenderer, ASquareCastsTheShadowThatGeometrySays) {
  for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point}) {
    SCOPED_TRACE(int(kind));
    Wall wall(kind);
    const Scene& scene = wall.stage.scene;
    const Frame open = wall.frame;
    wall.frame.shadows = cast_on_device(scene, open);
    ASSERT_EQ(wall.frame.shadows.size(), 1u);
    const auto on_device = [&](const Frame& frame) {
      return gpu::render(test_context(), scene, frame, {.full_float = true}).color;
    };
    expect_shadow(wall, on_device(wall.frame), on_device(open));
    wall.frame.shadows = cast_on_host(scene, open);
    expect_shadow(wall, cpu::render(scene, wall.frame).picture.color,
                  cpu::render(scene, open).picture.color);
  }
}

TEST_F(GpuRenderer, RefinedPixelsHaveTheShadowsToo) {
  Wall wall(LightKind::directional);
  const Frame open = wall.frame;
  wall.frame.shadows = cast_on_device(wall.stage.scene, open);
  gpu::Antialiaser antialiaser(test_context(), wall.stage.scene);
  constexpr float all = -1;  // contrast
  expect_shadow(wall, antialiaser.adaptive(wall.frame, all, 1).color,
                antialiaser.adaptive(open, all, 1).color, 1.0 / 33);
}

TEST_F(GpuRenderer, APlaneNeverShadowsItself) {
  TestScene stage;
  stage.add_material().metallic = 0;
  stage.add(square(3, 0));
  stage.add_light(directional(1));
  Frame frame = stage.frame();
  for (const double angle : {0.0, 0.6, 1.2, 1.5})
    for (const int radius : {0, 1, 3}) {
      frame.shadows.clear();
      frame.lights[0].direction = {std::sin(angle) * 0.8, std::sin(angle) * 0.6, -std::cos(angle)};
      const Grid<vec4> open = gpu::render(test_context(), stage.scene, frame).color;
      frame.shadows = cast_on_device(stage.scene, frame, {.side = 128, .radius = radius});
      EXPECT_EQ(gpu::render(test_context(), stage.scene, frame).color, open) << angle << radius;
      frame.shadows[0].bias = -0.01f;
      for (ShadowCascade& cascade : frame.shadows[0].cascades) cascade.texel = 0;
      EXPECT_NE(gpu::render(test_context(), stage.scene, frame).color, open) << "not lifted";
    }
}

TEST_F(GpuRenderer, ShadowsAreThoseOfTheReference) {
  const Scene scene = load_scene(std::filesystem::path(PARITY_SOURCE_DIR) / "assets/demo.glb");
  Frame frame = make_frame(scene, {.width = 149, .height = 101});
  frame.shadows = cast_on_device(scene, frame);
  const std::vector<LightShadow> host = cast_on_host(scene, frame);
  ASSERT_EQ(frame.shadows.size(), host.size());
  ASSERT_EQ(host.size(), 3u) << "a sun, a spot and a lamp";
  for (std::size_t i = 0; i < host.size(); ++i)
    for (std::size_t k = 0; k < host[i].cascades.size(); ++k) {
      const Grid<float>& a = frame.shadows[i].cascades[k].depths;
      const Grid<float>& b = host[i].cascades[k].depths;
      int apart = 0;
      // Depths that lie on steep planes round otherwise; which triangle is in front may change.
      for (std::size_t t = 0; t < a.size(); ++t)
        apart += std::abs(a.values()[t] - b.values()[t]) > 0x1p-16f;
      EXPECT_LE(apart, int(a.size()) / 1000) << i << ", " << k;
    }
  const raster_test::Agreement agreement =
      raster_test::draw_and_compare(test_context(), scene, frame);
  EXPECT_EQ(agreement.wrong(), 0u) << agreement.text();
  Frame open = frame;
  open.shadows.clear();
  const Grid<vec4> with = gpu::render(test_context(), scene, frame).color;
  const Grid<vec4> without = gpu::render(test_context(), scene, open).color;
  int darker = 0;
  for (std::size_t i = 0; i < with.size(); ++i)
    darker += with.values()[i].x < 0.9f * without.values()[i].x;
  EXPECT_GT(darker, 300);
  const Grid<vec4> general = gpu::render(test_context(), scene, frame, {.general = true}).color;
  EXPECT_EQ(with, general);
}

TEST(CastShadows, RefusesSidesAndRadii) {
  const TestScene stage;
  for (const ShadowOptions& options : {ShadowOptions{.side = 8}, ShadowOptions{.side = 10000},
                                       ShadowOptions{.radius = 9}, ShadowOptions{.radius = -1}})
    EXPECT_THROW(cast_shadows(stage.scene, stage.frame(), options, {}), std::invalid_argument);
}

TEST(CastShadows, AnEmptySceneHasNone) {
  TestScene stage;
  stage.add_light(directional(1));
  EXPECT_TRUE(cast_shadows(stage.scene, stage.frame(), {}, {}).empty());
}

}  // namespace
}  // namespace parity
