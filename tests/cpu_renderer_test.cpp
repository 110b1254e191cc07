#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <random>

#include "tests/small_scene.h"

namespace parity {
namespace {

TEST(CpuRenderer, AlphaMaskKeepsWhatReachesTheCutoff) {
  SmallScene stage;
  stage.add(quad(stage.add_material(unlit({0, 0, 1, 1})), -1.5f));
  Material m = unlit({1, 0, 0, 0.5f});
  m.alpha_mode = AlphaMode::mask;
  m.alpha_cutoff = 0.5f;
  stage.add(quad(stage.add_material(m)));
  expect_color(stage.render().color(1, 1), {1, 0, 0, 1}, 0);
  stage.scene.materials.back().alpha_cutoff = 0.51f;
  expect_color(stage.render().color(1, 1), {0, 0, 1, 1}, 0);
}

TEST(CpuRenderer, BlendsTwoLayersFarToNearWhateverTheirOrder) {
  for (const bool near_first : {false, true}) {
    SmallScene stage;
    Material red = unlit({1, 0, 0, 0.5f}), green = unlit({0, 1, 0, 0.25f});
    red.alpha_mode = green.alpha_mode = AlphaMode::blend;
    const int far = stage.add_material(red), near = stage.add_material(green);
    if (near_first) stage.add(quad(near, -1.0f));
    stage.add(quad(far, -2.0f));
    if (!near_first) stage.add(quad(near, -1.0f));
    Frame frame = stage.frame();
    frame.options.background = {0, 0, 1, 0.5f};
    const Picture p = cpu::render(stage.scene, frame).picture;
    // Blue 0.5 premultiplied; red over it; green over both. All exact in binary.
    expect_color(p.color(5, 2), {0.375, 0.25, 0.1875, 0.25 + 0.75 * (0.5 + 0.5 * 0.5)}, 0);
    EXPECT_EQ(p.depth(5, 2), 0.0f) << "blended layers do not write depth";
  }
}

TEST(CpuRenderer, HidesBlendedLayersBehindOpaqueOnes) {
  SmallScene stage;
  Material red = unlit({1, 0, 0, 0.5f});
  red.alpha_mode = AlphaMode::blend;
  stage.add(quad(stage.add_material(red), -2.0f));
  stage.add(quad(stage.add_material(unlit({0, 1, 0, 1})), -1.0f));
  expect_color(stage.render().color(5, 2), {0, 1, 0, 1}, 0);
}

TEST(CpuRenderer, CullsTheBackOfSingleSidedMaterialsAndOfMirroredOnes) {
  const dmat4 mirror = glm::scale(dmat4(1.0), dvec3(-1, 1, 1));
  const dmat4 around = glm::translate(dmat4(1.0), dvec3(0, 0, -2)) * turned(pi);
  const auto seen = [](const dmat4& place) {
    SmallScene stage;
    stage.add(quad(stage.add_material(unlit(vec4(1)))), place);
    return stage.render().color(4, 4).x == 1.0f;
  };
  EXPECT_TRUE(seen(dmat4(1.0)));
  EXPECT_TRUE(seen(mirror));
  EXPECT_FALSE(seen(around));
  EXPECT_FALSE(seen(around * mirror));
}

TEST(CpuRenderer, TakesTheMipLevelOfThePixelsFootprint) {
  // A checkerboard of single texels, 16 a pixel: level 4 of 7 is 8x8, one texel a pixel, all grey.
  SmallScene stage;
  Grid<u8vec4> board{128, 128};
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x) board(x, y) = u8vec4(u8vec4::value_type((x + y) % 2 * 255));
  stage.add_texture(board, {});
  Material m;
  m.metallic = 0;
  m.occlusion_texture.texture = 0;
  stage.add(quad(stage.add_material(m)));
  Frame frame = stage.frame();
  frame.ambient = vec3(1.0f);
  const Picture p = cpu::render(stage.scene, frame).picture;
  // 0.5 is stored as code 128 (round half up).
  for (const vec4& c : p.color) EXPECT_NEAR(c.x, 128 / 255.0, stored);
}

TEST(CpuRenderer, TakesTheLongerSideOfAnUprightFootprint) {
  // Rows alternate in pairs: 4 texels a pixel down, 1/2 across; level 2 averages 4 rows to grey.
  SmallScene stage;
  Grid<u8vec4> rows{4, 32};
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 4; ++x) rows(x, y) = u8vec4(u8vec4::value_type(y / 2 % 2 * 255));
  stage.add_texture(rows, {});
  Material m;
  m.metallic = 0;
  m.occlusion_texture.texture = 0;
  stage.add(quad(stage.add_material(m)));
  Frame frame = stage.frame();
  frame.ambient = vec3(1.0f);
  const Picture p = cpu::render(stage.scene, frame).picture;
  for (const vec4& c : p.color) EXPECT_NEAR(c.x, 128 / 255.0, stored);
}

TEST(CpuRenderer, EveryDepthModeStoresItsFormula) {
  Scene scene;
  Camera camera;
  camera.near = 0.5;
  camera.far = 8.0;
  scene.cameras.push_back(camera);
  Node node;
  node.camera = 0;
  scene.nodes.push_back(node);
  SmallScene stage;
  stage.scene = scene;
  stage.add(quad(stage.add_material(unlit(vec4(1))), -2.0f, 8.0f));
  // z = 2: standard f (z - n) / (z (f - n)); reverse 1 - that; log2(4) / log2(16).
  const double standard = 8.0 * 1.5 / (2.0 * 7.5);
  const auto depth = [&](DepthMode mode) {
    return cpu::render(stage.scene, stage.frame(8, 1, mode)).picture.depth(4, 4);
  };
  // The projection is rounded to float: two entries of half an ulp of at most 1.1, over w = 2.
  EXPECT_NEAR(depth(DepthMode::standard), standard, 1.2e-7);
  EXPECT_NEAR(depth(DepthMode::reverse_z), 1 - standard, 1.2e-7);
  EXPECT_NEAR(depth(DepthMode::logarithmic), 0.5, stored);
}

TEST(CpuRenderer, FillsTheScreenEquallyWithAnyNumberOfSamples) {
  SmallScene stage;
  Material m;
  m.metallic = 0;
  m.roughness = 0.4f;
  stage.add(quad(stage.add_material(m)));
  Light light;
  stage.add_light(light);
  const Picture one = stage.render(13);
  for (const int samples : {2, 4, 8}) {
    const Picture many = stage.render(13, samples);
    EXPECT_EQ(many.color, one.color) << samples;
  }
}

TEST(CpuRenderer, AveragesTheSamplesOfAHalfCoveredPixel) {
  SmallScene stage;
  Primitive p = quad(stage.add_material(unlit(vec4(1))));
  for (vec3& v : p.positions) v.x = v.x * 0.5f + 0.125f;  // right border at x = 5/8: mid-pixel 6
  stage.add(p);
  for (const int samples : {2, 4, 8})
    EXPECT_EQ(stage.render(8, samples).color(6, 3).x, 0.5f) << samples;
}

TEST(CpuRenderer, DrawsPointsAndLinesOnePixelWide) {
  SmallScene stage;
  Primitive points;
  points.topology = Topology::points;
  points.material = stage.add_material(unlit({0.5f, 1, 1, 1}));
  points.positions = {{-0.8125f, 0.8125f, -1}};  // (0.75, 0.75) px: reaches one centre
  points.colors = {vec4(1, 0.5f, 0.25f, 1)};
  points.indices = {0};
  stage.add(points);
  Primitive line = points;
  line.topology = Topology::lines;
  line.positions = {{-1, 0.125f, -1}, {1, 0.125f, -1}};
  line.colors = {vec4(0, 0, 0, 1), vec4(1, 0, 0, 1)};
  line.indices = {0, 1};
  stage.add(line);
  const Picture p = stage.render();
  int drawn = 0;
  for (const std::uint32_t e : p.element) drawn += e != 0;
  EXPECT_EQ(drawn, 1 + 8);
  expect_color(p.color(0, 0), {0.5, 0.5, 0.25, 1}, 0);
  EXPECT_EQ(p.element(0, 0), 1u);
  for (int x = 0; x < 8; ++x) {
    EXPECT_EQ(p.element(x, 3), 2u);
    EXPECT_NEAR(p.color(x, 3).x, 0.5 * (x + 0.5) / 8, stored);
  }
  EXPECT_EQ(p.triangle_count, 0u);
}

TEST(CpuRenderer, FillsEveryRowThatAQuadReaches) {
  constexpr int size = 40;
  for (int rows = 1; rows <= size; ++rows) {
    SmallScene stage;
    Primitive p = quad(stage.add_material(unlit(vec4(1))));
    p.positions[2].y = p.positions[3].y = 1.0f - 2.0f * float(rows) / size;
    stage.add(p);
    int drawn = 0;
    for (const std::uint32_t e : stage.render(size).element) drawn += e != 0;
    EXPECT_EQ(drawn, rows * size);
  }
}

TEST(CpuRenderer, TakesDerivativesInsideOfThePixelsQuad) {
  const std::array<vec4, 3> clip{vec4(-1, 1, 0, 1), vec4(2, 2, 0, 2), vec4(-3, -3, 0, 3)};
  Primitive p;
  p.indices = {0, 1, 2};
  cpu::PlacedDraw draw;
  draw.primitive = &p;
  draw.clip.assign(clip.begin(), clip.end());
  draw.element_count = 1;
  const cpu::Planes planes = cpu::element_planes(draw, 0, 8, 8);
  for (int y = 2; y < 4; ++y)
    for (int x = 2; x < 4; ++x) {
      const cpu::QuadBarycentrics b = cpu::quad_barycentrics(planes, x, y);
      EXPECT_EQ(b.beside, cpu::barycentric(planes, x == 2 ? 3.5 : 2.5, y + 0.5));
      EXPECT_EQ(b.below, cpu::barycentric(planes, x + 0.5, y == 2 ? 3.5 : 2.5));
      EXPECT_EQ(b.right, x == 2 ? 1 : -1);
      EXPECT_EQ(b.down, y == 2 ? 1 : -1);
    }
}

TEST(CpuRenderer, InterpolatesInPerspective) {
  // An edge-lit floor: at half the height of the picture's lower half the floor is twice as far.
  Scene scene;
  Camera camera;
  camera.vertical_fov = pi / 2;
  camera.near = 0.1;
  scene.cameras.push_back(camera);
  Node node;
  node.camera = 0;
  scene.nodes.push_back(node);
  SmallScene stage;
  stage.scene = scene;
  Primitive floor = quad(stage.add_material(unlit(vec4(1))));
  floor.positions = {{-50, -1, -21}, {50, -1, -21}, {50, -1, 1}, {-50, -1, 1}};
  floor.colors = {vec4(21, 0, 0, 1), vec4(21, 0, 0, 1), vec4(-1, 0, 0, 1), vec4(-1, 0, 0, 1)};
  stage.add(floor);
  const int size = 64;
  const Picture p = stage.render(size);
  // The colour is the distance in z: pixel row y looks down by (y + 0.5) / 32 - 1.
  for (int y = 40; y < size; ++y) {
    const double distance = 1 / ((y + 0.5) / 32 - 1);
    EXPECT_NEAR(p.color(20, y).x, distance, distance * 3e-7) << y;
  }
}

/// A heap of coloured, partly transparent triangles.
SmallScene heap() {
  SmallScene stage;
  Material m;
  m.double_sided = true;
  const int solid = stage.add_material(m);
  m.alpha_mode = AlphaMode::blend;
  m.base_color.w = 0.5f;
  const int glass = stage.add_material(m);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> anywhere(-1.2f, 1.2f);
  for (const int material : {solid, glass}) {
    Primitive p;
    p.material = material;
    for (std::uint32_t i = 0; i < 120; ++i) {
      p.positions.emplace_back(anywhere(random), anywhere(random), anywhere(random) - 1.5f);
      p.normals.push_back(glm::normalize(vec3(anywhere(random), anywhere(random), 1.5f)));
      p.colors.emplace_back(vec3(std::abs(anywhere(random))) / 1.2f, 1.0f);
      p.indices.push_back(i);
    }
    stage.add(p);
  }
  stage.add_light(Light{});
  return stage;
}

TEST(CpuRenderer, GivesTheSameBitsWithAnyNumberOfThreads) {
  const SmallScene stage = heap();
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const Picture one = stage.render(131, 4);
  for (const int threads : {2, 3}) {
    omp_set_num_threads(threads);
    const Picture many = stage.render(131, 4);
    EXPECT_EQ(many.color, one.color);
    EXPECT_EQ(many.depth, one.depth);
    EXPECT_EQ(many.element, one.element);
  }
  omp_set_num_threads(before);
}

TEST(CpuRenderer, ReportsProgressUpToOne) {
  const SmallScene stage = heap();
  double last = 0;
  cpu::render(stage.scene, stage.frame(100), {}, [&](double part) {
    EXPECT_GT(part, last);
    last = part;
  });
  EXPECT_EQ(last, 1.0);
}

TEST(CpuRenderer, RendersAnEmptySceneAsBackground) {
  SmallScene stage;
  Frame frame = stage.frame(5);
  frame.options.background = {1, 0.5f, 0.25f, 0.5f};
  const Picture p = cpu::render(stage.scene, frame).picture;
  for (const vec4& c : p.color) EXPECT_EQ(c, vec4(0.5f, 0.25f, 0.125f, 0.5f));
  for (const float d : p.depth) EXPECT_EQ(d, 0.0f);
}

TEST(CpuRenderer, RefusesLogarithmicDepthWithoutAFarPlane) {
  const SmallScene stage;
  Frame frame = stage.frame(5);
  frame.options.depth = DepthMode::logarithmic;
  frame.far = 0;
  EXPECT_THROW(cpu::render(stage.scene, frame), std::invalid_argument);
}

}  // namespace
}  // namespace parity
