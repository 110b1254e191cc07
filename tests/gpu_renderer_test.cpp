#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "gpu/raster/half.h"
#include "tests/renderer_scene.h"

namespace parity {
namespace {

TEST(Renderer, RefusesADeviceThatCannotCompileIt) {
  EXPECT_FALSE(gpu::can_render({.is_swiftshader = true}));
  if (gpu::can_render(test_context().info())) return;
  EXPECT_THROW(gpu::Renderer(test_context(), TestScene().scene), gpu::Error);
}

TEST_F(GpuRenderer, AnEmptySceneShowsTheBackgroundPremultiplied) {
  TestScene stage;
  stage.options.background = vec4(0.5f, 0.25f, 1.0f, 0.5f);
  const Picture picture = stage.render({.elements = true, .full_float = true});
  for (const vec4& pixel : picture.color) expect_near(pixel, vec4(0.25f, 0.125f, 0.5f, 0.5f), 0);
  for (const std::uint32_t element : picture.element) EXPECT_EQ(element, 0u);
  for (const float depth : picture.depth) EXPECT_EQ(depth, 0.0f);
  EXPECT_EQ(picture.triangle_count, 0u);
}

TEST_F(GpuRenderer, ASquareLitHeadOnHasTheAnalyticRadiance) {
  TestScene stage;
  Material& material = stage.add_material();
  material.base_color = vec4(0.8f, 0.5f, 0.2f, 1.0f);
  material.metallic = 0;
  material.roughness = 0.7f;
  stage.add(square(2, 0));
  stage.add_light(directional(3));
  const vec4 got = middle(stage.render());
  const double alpha4 = 3 * head_on(0, 0.7f);
  expect_near(
      got,
      vec4(3 * 0.96 * 0.8 / std::numbers::pi + alpha4, 3 * 0.96 * 0.5 / std::numbers::pi + alpha4,
           3 * 0.96 * 0.2 / std::numbers::pi + alpha4, 1),
      shading_tolerance);
}

TEST_F(GpuRenderer, APointLightFallsOffWithTheSquareAndEndsAtItsRange) {
  TestScene stage;
  Material& material = stage.add_material();
  material.metallic = 0;
  stage.add(square(2, 0));
  Light light;
  light.intensity = 100;
  light.range = 10;
  stage.add_light(light);
  const double window = 1 - std::pow(5.0 / 10.0, 4);
  expect_near(middle(stage.render()), vec4(vec3(100 / 25.0 * window * head_on(1, 1)), 1),
              4 * shading_tolerance);
  stage.scene.lights[0].range = 4.9f;
  expect_near(middle(stage.render()), vec4(0, 0, 0, 1), 0);
}

TEST_F(GpuRenderer, ASpotLightIsDarkOutsideItsConeAndFullInside) {
  TestScene stage;
  Material& material = stage.add_material();
  material.metallic = 0;
  stage.add(square(2, 0));
  Light light;
  light.kind = LightKind::spot;
  light.intensity = 25;
  light.inner_cone_angle = 0.05f;
  light.outer_cone_angle = 0.1f;  // reaches 0.5 of the 1 that the picture shows
  stage.add_light(light);
  const Picture picture = stage.render();
  expect_near(middle(picture), vec4(vec3(head_on(1, 1)), 1), 2 * shading_tolerance);
  expect_near(picture.color(0, 16), vec4(0, 0, 0, 1), 0);
}

TEST_F(GpuRenderer, AWhiteDielectricVanishesInAUniformEnvironment) {
  TestScene stage;
  Material& material = stage.add_material();
  material.metallic = 0;
  material.roughness = 0.4f;
  stage.add(square(3, 0), dmat4(glm::mat3_cast(dquat(std::cos(0.4), 0, std::sin(0.4), 0))));
  Frame frame = stage.frame();
  frame.lights.clear();
  frame.ambient = vec3(0.25f, 0.5f, 2.0f);
  const Picture picture =
      gpu::render(test_context(), stage.scene, frame, {.elements = false, .full_float = true});
  for (const vec4& pixel : picture.color)
    expect_near(pixel, vec4(0.25f, 0.5f, 2.0f, 1.0f), 2 * shading_tolerance);
}

TEST_F(GpuRenderer, AMaskKeepsWhatReachesTheCutoff) {
  TestScene stage;
  Grid<u8vec4> image(3, 1, u8vec4(255));
  image(0, 0).w = 127;
  image(1, 0).w = 128;
  const int texture = stage.add_texture(image, nearest());
  Material& material = stage.add_unlit(vec4(1));
  material.alpha_mode = AlphaMode::mask;
  material.alpha_cutoff = float(128.0 / 255.0);
  material.base_color_texture.texture = texture;
  stage.add(square(1, 0));
  const Picture picture = stage.render({.elements = true, .full_float = true});
  expect_near(picture.color(5, 16), vec4(0), 0);
  expect_near(picture.color(16, 16), vec4(1), 0);
  expect_near(picture.color(27, 16), vec4(1), 0);
  EXPECT_EQ(picture.depth(5, 16), 0.0f);
  EXPECT_EQ(picture.element(5, 16), 0u);
  EXPECT_GT(picture.depth(27, 16), 0.0f);
}

TEST_F(GpuRenderer, BlendedLayersAreSortedAndDrawnOver) {
  TestScene stage;
  stage.add_unlit(vec4(1, 0, 0, 0.5f)).alpha_mode = AlphaMode::blend;
  stage.add_unlit(vec4(0, 1, 0, 0.25f)).alpha_mode = AlphaMode::blend;
  stage.add_unlit(vec4(0, 0, 1, 1));
  stage.add(square(2, 1, 0));   // near, first in the scene
  stage.add(square(2, 0, 1));   // far
  stage.add(square(2, 2, 1));   // nearer
  stage.add(square(2, -1, 2));  // opaque, behind
  stage.add(square(2, -2, 0));  // hidden
  const vec4 want(0.5f * 0.75f, 0.25f + 0.75f * 0.5f * 0.25f, 0.75f * 0.5f * 0.75f, 1);
  const Picture picture = stage.render({.elements = true, .full_float = true});
  expect_near(middle(picture), want, 0);
  // The opaque square's triangles are numbers 7 and 8 of all; blending leaves depth and element.
  EXPECT_TRUE(picture.element(16, 20) == 7u || picture.element(16, 20) == 8u);
  const double near = 1;
  const double far = 100;
  EXPECT_NEAR(picture.depth(16, 16), near * (far - 6) / (6 * (far - near)), 4 * 0x1p-24);
}

TEST_F(GpuRenderer, AMirroredSquareStillFacesTheViewerAndATurnedOneDoesNot) {
  TestScene stage;
  stage.add_unlit(vec4(1));
  dmat4 mirror(1.0);
  mirror[0][0] = -1;
  stage.add(square(2, 0), mirror);
  expect_near(middle(stage.render()), vec4(1), 0);
  dmat4 turn(1.0);
  turn[0][0] = turn[2][2] = -1;
  stage.scene.nodes.back().parent_from_node = turn;
  expect_near(middle(stage.render()), vec4(0), 0);
  stage.scene.materials[0].double_sided = true;
  expect_near(middle(stage.render()), vec4(1), 0);
}

TEST_F(GpuRenderer, BlendedBackFacesAreCulledUnlessDoubleSided) {
  TestScene stage;
  stage.add_unlit(vec4(1, 1, 1, 0.5f)).alpha_mode = AlphaMode::blend;
  dmat4 turn(1.0);
  turn[0][0] = turn[2][2] = -1;
  stage.add(square(2, 0), turn);
  expect_near(middle(stage.render()), vec4(0), 0);
  stage.scene.materials[0].double_sided = true;
  expect_near(middle(stage.render()), vec4(0.5f), 0);
  dmat4 mirror(1.0);
  mirror[1][1] = -1;
  stage.scene.nodes.back().parent_from_node = mirror;
  stage.scene.materials[0].double_sided = false;
  expect_near(middle(stage.render()), vec4(0.5f), 0);
}

TEST_F(GpuRenderer, TheBackOfADoubleSidedSquareIsLitLikeTheFront) {
  TestScene stage;
  Material& material = stage.add_material();
  material.metallic = 0;
  material.double_sided = true;
  dmat4 turn(1.0);
  turn[0][0] = turn[2][2] = -1;
  stage.add(square(2, 0), turn);
  stage.add_light(directional(1));
  expect_near(middle(stage.render()), vec4(vec3(head_on(1, 1)), 1), shading_tolerance);
}

TEST_F(GpuRenderer, EverySampleCountShowsAFullSquareAlike) {
  TestScene stage;
  Material& material = stage.add_material();
  material.base_color = vec4(0.2f, 0.5f, 0.9f, 1);
  stage.add(square(2, 0));
  Light light;
  light.intensity = 50;
  stage.add_light(light, dvec3(0.5, 0.5, 3));
  const Picture single = stage.render();
  for (const int samples : {2, 4, 8}) {
    stage.options.samples = samples;
    const Picture several = stage.render({.elements = true, .full_float = true});
    for (std::size_t i = 0; i < single.color.size(); ++i)
      expect_near(several.color.values()[i], single.color.values()[i], shading_tolerance);
    for (const std::uint32_t element : several.element) EXPECT_TRUE(element == 1u || element == 2u);
  }
}

TEST_F(GpuRenderer, AnEdgeIsCoveredByTheShareOfItsSamples) {
  // The right half of a pixel column: x > 0 covers the sample places with x > 1/2 of pixel 16.
  const std::array<std::pair<int, double>, 4> shares{{{1, 1.0}, {2, 0.5}, {4, 0.5}, {8, 0.5}}};
  for (const auto& [samples, share] : shares) {
    TestScene stage;
    stage.add_unlit(vec4(1));
    parity::Primitive primitive = square(2, 0);
    primitive.positions[0].x = primitive.positions[3].x = 0;
    stage.add(primitive);
    stage.options.samples = samples;
    const Picture picture = stage.render();
    EXPECT_EQ(picture.color(15, 16).x, 0.0f) << samples;
    EXPECT_EQ(picture.color(16, 16).x, float(share)) << samples;
    EXPECT_EQ(picture.color(17, 16).x, 1.0f) << samples;
  }
}

TEST_F(GpuRenderer, DepthFollowsItsConvention) {
  TestScene stage;
  stage.add_unlit(vec4(1));
  stage.add(square(2, 0));
  const double n = 1;
  const double f = 100;
  const double w = 5;
  const std::array<std::pair<DepthMode, double>, 3> wants{
      {{DepthMode::standard, f * (w - n) / (w * (f - n))},
       {DepthMode::reverse_z, n * (f - w) / (w * (f - n))},
       {DepthMode::logarithmic, std::log2(w / n) / std::log2(f / n)}}};
  for (const auto& [mode, want] : wants) {
    stage.options.depth = mode;
    // log2 may be off by 3 units in the last place, here of 2.3.
    EXPECT_NEAR(stage.render().depth(16, 16), want, 8 * 0x1p-24) << int(mode);
  }
}

TEST_F(GpuRenderer, TheNearerSquareIsSeenInEveryDepthMode) {
  for (const DepthMode mode : {DepthMode::standard, DepthMode::reverse_z, DepthMode::logarithmic}) {
    TestScene stage;
    stage.add_unlit(vec4(1, 0, 0, 1));
    stage.add_unlit(vec4(0, 1, 0, 1));
    stage.add(square(2, -1, 0));
    stage.add(square(2, 1, 1));
    stage.add(square(2, 0, 0));
    stage.options.depth = mode;
    const Picture picture = stage.render({.elements = true, .full_float = true});
    expect_near(middle(picture), vec4(0, 1, 0, 1), 0);
    EXPECT_TRUE(picture.element(16, 20) == 3u || picture.element(16, 20) == 4u);
  }
}

TEST_F(GpuRenderer, OfEqualDepthsTheFirstIsKept) {
  TestScene stage;
  stage.add_unlit(vec4(1, 0, 0, 1)).alpha_mode = AlphaMode::mask;
  stage.add_unlit(vec4(0, 1, 0, 1)).double_sided = true;
  stage.add(square(2, 0, 1));
  stage.add(square(2, 0, 0));
  expect_near(middle(stage.render()), vec4(0, 1, 0, 1), 0);
}

TEST_F(GpuRenderer, PointsAndLinesShowTheirBaseColour) {
  for (const int samples : {1, 2, 4}) {
    TestScene stage;
    stage.add_material().base_color = vec4(1, 0.5f, 0.25f, 1);
    parity::Primitive points;
    points.topology = Topology::points;
    points.material = 0;
    points.positions = {{0, 0, 0}, {-0.5f, 0.5f, 0}};
    points.indices = {0, 1};
    points.colors = {{1, 1, 1, 1}, {0, 1, 1, 1}};
    stage.add(points);
    parity::Primitive line = points;
    line.topology = Topology::lines;
    // From the middle of pixel 24 of row 4 downwards to row 28.
    line.positions = {{8 * 2 / 33.0f, 12 * 2 / 33.0f, 0}, {8 * 2 / 33.0f, -12 * 2 / 33.0f, 0}};
    line.colors.clear();
    stage.add(line);
    stage.options.samples = samples;
    const Picture picture = stage.render({.elements = true, .full_float = true});
    expect_near(middle(picture), vec4(1, 0.5f, 0.25f, 1), shading_tolerance);
    EXPECT_EQ(picture.element(16, 16), 1u);
    for (int y = 6; y < 27; ++y) {
      expect_near(picture.color(24, y), vec4(1, 0.5f, 0.25f, 1), shading_tolerance);
      EXPECT_EQ(picture.element(24, y), 3u);
    }
    int lit = 0;
    for (int x = 0; x < 33; ++x) lit += picture.color(x, 10).w > 0 ? 1 : 0;
    EXPECT_EQ(lit, 1) << "the line is one pixel wide";
  }
}

TEST_F(GpuRenderer, SingularAndOutOfViewPlacesDrawNothingAndHarmNothing) {
  TestScene stage;
  Material& material = stage.add_material();
  material.double_sided = true;
  stage.add(square(2, 0), dmat4(0.0));
  dmat4 flat(1.0);
  flat[2][2] = 0;
  stage.add(square(0.5f, 3), flat);
  dmat4 behind(1.0);
  behind[3] = dvec4(0, 0, 50, 1);
  stage.add(square(2, 0), behind);
  stage.add_light(directional(1));
  for (const int samples : {1, 2}) {
    stage.options.samples = samples;
    for (const vec4& pixel : stage.render().color)
      for (int i = 0; i < 4; ++i) EXPECT_TRUE(std::isfinite(pixel[i]));
  }
}

TEST_F(GpuRenderer, FramesOfOneRendererAreEqualBitByBit) {
  TestScene stage;
  stage.add_material();
  stage.add(square(0.7f, 0));
  stage.add_light(directional(1));
  gpu::Renderer renderer(test_context(), stage.scene);
  const Frame frame = stage.frame();
  const Picture first = renderer.render(frame);
  stage.options.width = 50;
  renderer.render(stage.frame());
  const Picture again = renderer.render(frame);
  EXPECT_EQ(first.color, again.color);
  EXPECT_EQ(first.depth, again.depth);
  EXPECT_GT(first.memory_bytes, 0u);
}

TEST_F(GpuRenderer, HalfPrecisionEndsAtItsLargestNumber) {
  TestScene stage;
  stage.add_unlit(vec4(1e9f, 1, 0.333333343f, 1));
  stage.add(square(2, 0));
  const vec4 got = middle(stage.render({.elements = false, .full_float = false}));
  EXPECT_EQ(got.x, 65504.0f);
  EXPECT_EQ(got.y, 1.0f);
  EXPECT_NEAR(got.z, 0.333333343, 0.333 * 0x1p-11);
}

TEST_F(GpuRenderer, ComputeKernelsAndPipelineAgreeInTheMiddleOfTriangles) {
  for (const DepthMode mode : {DepthMode::standard, DepthMode::reverse_z, DepthMode::logarithmic}) {
    TestScene stage = everything();
    stage.options.depth = mode;
    const Picture pipeline = stage.render({.elements = true, .full_float = true});
    stage.options.samples = 8;
    const Picture kernels = stage.render({.elements = true, .full_float = true});
    int compared = 0;
    for (int y = 2; y < 31; ++y)
      for (int x = 2; x < 31; ++x) {
        if (pipeline.element(x, y) != kernels.element(x, y)) continue;
        bool flat = true;  // no edge and no cut near: all around shows one element
        for (int k = 0; k < 9; ++k)
          flat &= pipeline.element(x + k % 3 - 1, y + k / 3 - 1) == pipeline.element(x, y);
        // Blended triangles may change their order at the squares' diagonals.
        if (!flat || std::abs(x - y) < 3 || std::abs(x + y - 32) < 3) continue;
        ++compared;
        // Varyings at 8 bits of sub-pixel snapping, and a texture whose slope is 8 texels to 22
        // pixels: 2^-9 pixel times slopes of at most 2 a pixel.
        expect_near(kernels.color(x, y), pipeline.color(x, y), 0x1p-8);
      }
    EXPECT_GT(compared, 300);
  }
}

TEST_F(GpuRenderer, EverythingAtOnceIsFinite) {
  TestScene stage = everything();
  for (const int samples : {1, 4, 8}) {
    stage.options.samples = samples;
    const Picture picture = stage.render({.elements = false, .full_float = false});
    EXPECT_GT(middle(picture).x, 0);
    for (const vec4& pixel : picture.color)
      for (int i = 0; i < 4; ++i) EXPECT_TRUE(std::isfinite(pixel[i]));
  }
}

TEST_F(GpuRenderer, LogarithmicDepthNeedsAFarPlane) {
  TestScene stage;
  stage.scene.cameras[0].far.reset();
  Frame frame = stage.frame();
  frame.options.depth = DepthMode::logarithmic;
  EXPECT_THROW(gpu::render(test_context(), stage.scene, frame), std::invalid_argument);
}

TEST(Half, EveryCodeHasItsValue) {
  EXPECT_EQ(gpu::float_from_half(0x3c00), 1.0f);
  EXPECT_EQ(gpu::float_from_half(0xc000), -2.0f);
  EXPECT_EQ(gpu::float_from_half(0x7bff), 65504.0f);
  EXPECT_EQ(gpu::float_from_half(0x0001), 0x1p-24f);
  EXPECT_EQ(gpu::float_from_half(0x83ff), -1023 * 0x1p-24f);
  EXPECT_EQ(gpu::float_from_half(0x7c00), std::numeric_limits<float>::infinity());
  EXPECT_TRUE(std::isnan(gpu::float_from_half(0x7e00)));
}

}  // namespace
}  // namespace parity
