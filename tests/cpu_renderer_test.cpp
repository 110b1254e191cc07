#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <random>

#include "cpu_reference/raster/renderer.h"

namespace parity {
namespace {

constexpr double pi = std::numbers::pi;
/// A double stored as float: half an ulp.
constexpr double stored = 6e-8;

/// A scene seen by an orthographic camera at the origin that looks along -z at [-1, 1]^2.
struct Stage {
  Scene scene;

  Stage() {
    Camera camera;
    camera.orthographic = true;
    camera.near = 0.5;
    camera.far = 2.5;
    scene.cameras.push_back(camera);
    Node node;
    node.camera = 0;
    scene.nodes.push_back(node);
  }

  int add_material(const Material& material) {
    scene.materials.push_back(material);
    return int(scene.materials.size()) - 1;
  }

  void add(Primitive primitive, const dmat4& place = dmat4(1.0)) {
    scene.meshes.push_back({"", {std::move(primitive)}});
    Node node;
    node.mesh = int(scene.meshes.size()) - 1;
    node.parent_from_node = place;
    scene.nodes.push_back(node);
  }

  void add_light(const Light& light, const dmat4& place = dmat4(1.0)) {
    scene.lights.push_back(light);
    Node node;
    node.light = int(scene.lights.size()) - 1;
    node.parent_from_node = place;
    scene.nodes.push_back(node);
  }

  void add_texture(const Grid<u8vec4>& image, const Sampler& sampler) {
    scene.images.push_back(image);
    scene.textures.push_back({int(scene.images.size()) - 1, sampler});
  }

  Frame frame(int size = 8, int samples = 1, DepthMode depth = DepthMode::reverse_z) const {
    FrameOptions options;
    options.width = size;
    options.height = size;
    options.samples = samples;
    options.depth = depth;
    Frame f = make_frame(scene, options);
    if (scene.lights.empty()) {  // the default light is none of these tests' business
      f.lights.clear();
      f.ambient = vec3(0.0f);
    }
    return f;
  }

  Picture render(int size = 8, int samples = 1) const {
    cpu::RenderOptions options;
    options.elements = true;
    return cpu::render(scene, frame(size, samples), options).picture;
  }
};

//  0---1    counter-clockwise seen from +z; uv (0, 0) top left
//  | / |
//  3---2
Primitive quad(int material, float z = -1.0f, float half = 1.0f) {
  Primitive p;
  p.material = material;
  p.positions = {{-half, half, z}, {half, half, z}, {half, -half, z}, {-half, -half, z}};
  p.normals.assign(4, vec3(0, 0, 1));
  p.tangents.assign(4, vec4(1, 0, 0, 1));
  p.uvs = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  p.indices = {0, 3, 1, 1, 3, 2};
  return p;
}

Material unlit(vec4 color) {
  Material m;
  m.unlit = true;
  m.base_color = color;
  return m;
}

/// Light that travels along -z, turned by `angle` around y.
dmat4 turned(double angle) { return glm::rotate(dmat4(1.0), angle, dvec3(0, 1, 0)); }

void expect_color(const vec4& got, const dvec4& want, double tolerance) {
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(got[i], want[i], tolerance) << "channel " << i;
}

TEST(CpuRenderer, GivesTheAnalyticRadianceOfARoughQuadUnderADirectionalLight) {
  const double angle = 0.6;
  Stage stage;
  Material m;
  m.metallic = 0;
  m.base_color = {0.8f, 0.4f, 0.2f, 1.0f};
  stage.add(quad(stage.add_material(m)));
  Light light;
  light.kind = LightKind::directional;
  light.intensity = 3;
  light.color = {1.0f, 0.5f, 0.25f};
  stage.add_light(light, turned(angle));
  const Picture picture = stage.render();
  // Roughness 1: D = 1 / pi, V = 1 / (2 (n.l + n.v)); half vector at half the angle.
  const double n_dot_l = std::cos(angle);
  const double fresnel = 0.04 + 0.96 * std::pow(1 - std::cos(angle / 2), 5);
  for (int c = 0; c < 3; ++c) {
    const double f =
        (1 - fresnel) * double(m.base_color[c]) / pi + fresnel / pi * 0.5 / (n_dot_l + 1);
    EXPECT_NEAR(picture.color(3, 4)[c], f * 3 * double(light.color[c]) * n_dot_l, stored * 2);
  }
  EXPECT_EQ(picture.color(3, 4).w, 1.0f);
}

TEST(CpuRenderer, ShowsAWhiteDielectricAsItsUniformEnvironment) {
  for (const float roughness : {0.0f, 0.3f, 1.0f}) {
    Stage stage;
    Material m;
    m.metallic = 0;
    m.roughness = roughness;
    stage.add(quad(stage.add_material(m)));
    Frame frame = stage.frame();
    frame.ambient = {0.25f, 0.5f, 2.0f};
    const Picture picture = cpu::render(stage.scene, frame).picture;
    expect_color(picture.color(4, 4), {0.25, 0.5, 2.0, 1.0}, stored * 2);
  }
}

TEST(CpuRenderer, OcclusionDimsTheEnvironmentByItsStrength) {
  Stage stage;
  stage.add_texture(Grid<u8vec4>(1, 1, u8vec4(51, 255, 255, 255)), {});
  Material m;
  m.metallic = 0;
  m.occlusion_texture.texture = 0;
  m.occlusion_strength = 0.5f;
  stage.add(quad(stage.add_material(m)));
  Frame frame = stage.frame();
  frame.ambient = vec3(1.0f);
  const Picture picture = cpu::render(stage.scene, frame).picture;
  EXPECT_NEAR(picture.color(4, 4).x, 1 + 0.5 * (0.2 - 1), stored);
}

TEST(CpuRenderer, PointLightFallsOffWithTheSquareOfTheDistanceInsideItsRange) {
  Stage stage;
  Material m;
  m.metallic = 0;
  stage.add(quad(stage.add_material(m)));
  Light light;
  light.intensity = 5;
  light.range = 2;
  stage.add_light(light, glm::translate(dmat4(1.0), dvec3(0.125, 0.125, 0.5)));
  // The centre of pixel (4, 3) stands straight below the light at distance 1.5.
  const Picture picture = stage.render();
  const double f = 0.96 / pi + 0.04 / pi * 0.25;
  const double irradiance = 5 / 2.25 * (1 - std::pow(1.5 / 2, 4));
  EXPECT_NEAR(picture.color(4, 3).x, f * irradiance, stored);
  light.range = 1.25;
  Stage dark = stage;
  dark.scene.lights[0] = light;
  EXPECT_EQ(dark.render().color(4, 3).x, 0.0f);
}

TEST(CpuRenderer, SpotLightFadesBetweenItsCones) {
  Stage stage;
  Material m;
  m.metallic = 0;
  stage.add(quad(stage.add_material(m)));
  Light light;
  light.kind = LightKind::spot;
  light.inner_cone_angle = 0.2f;
  light.outer_cone_angle = 0.6f;
  const dmat4 above = glm::translate(dmat4(1.0), dvec3(0.125, 0.125, 0.0));
  const auto middle = [&](double tilt) {
    Stage s = stage;
    s.add_light(light, above * turned(tilt));
    return double(s.render().color(4, 3).x);
  };
  const double f = 0.96 / pi + 0.04 / pi * 0.25;
  EXPECT_NEAR(middle(0.1), f, stored);
  EXPECT_EQ(middle(0.7), 0.0);
  const double inner = std::cos(double(0.2f)), outer = std::cos(double(0.6f));
  const double part = (std::cos(0.4) - outer) / (inner - outer);
  EXPECT_NEAR(middle(0.4), f * part * part, stored);
}

TEST(CpuRenderer, AddsEmissionAndLeavesUnlitMaterialsAlone) {
  Stage stage;
  Material glowing;
  glowing.base_color = vec4(0, 0, 0, 1);
  glowing.emission = {3, 2, 1};
  stage.add(quad(stage.add_material(glowing)));
  stage.add(quad(stage.add_material(unlit({0.1f, 0.2f, 0.3f, 1})), -0.9f, 0.5f));
  const Picture picture = stage.render();
  expect_color(picture.color(0, 0), {3, 2, 1, 1}, 0);
  expect_color(picture.color(4, 4), {0.1f, 0.2f, 0.3f, 1}, 0);
}

TEST(CpuRenderer, AlphaMaskKeepsWhatReachesTheCutoff) {
  Stage stage;
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
    Stage stage;
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
  Stage stage;
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
    Stage stage;
    stage.add(quad(stage.add_material(unlit(vec4(1)))), place);
    return stage.render().color(4, 4).x == 1.0f;
  };
  EXPECT_TRUE(seen(dmat4(1.0)));
  EXPECT_TRUE(seen(mirror));
  EXPECT_FALSE(seen(around));
  EXPECT_FALSE(seen(around * mirror));
}

TEST(CpuRenderer, LightsTheBackOfDoubleSidedMaterialsAsTheFront) {
  Light light;
  light.kind = LightKind::directional;
  const auto lit = [&](const dmat4& place, bool mapped) {
    Stage stage;
    Material m;
    m.metallic = 0;
    m.double_sided = true;
    if (mapped) {
      stage.add_texture(Grid<u8vec4>(1, 1, u8vec4(200, 128, 255, 255)), {});
      m.normal_texture.texture = 0;
    }
    stage.add(quad(stage.add_material(m)), place);
    stage.add_light(light);
    return stage.render().color(4, 4).x;
  };
  const dmat4 around = glm::translate(dmat4(1.0), dvec3(0, 0, -2)) * turned(pi);
  for (const bool mapped : {false, true}) {
    EXPECT_GT(lit(dmat4(1.0), mapped), 0.1f);
    EXPECT_NEAR(lit(around, mapped), lit(dmat4(1.0), mapped), stored);
  }
}

TEST(CpuRenderer, NormalMapTurnsTheNormalTowardTheTangent) {
  // Texel (255, 128 - 0.5, 255) / 255 with scale s is (s, ~0, 1): a turn by atan(s) toward +x.
  const double angle = 0.5;
  Stage stage;
  stage.add_texture(Grid<u8vec4>(1, 1, u8vec4(255, 128, 255, 255)), {});
  Material m;
  m.metallic = 0;
  m.normal_texture.texture = 0;
  m.normal_scale = float(std::tan(angle));
  stage.add(quad(stage.add_material(m)));
  Light light;
  light.kind = LightKind::directional;
  stage.add_light(light, turned(angle));
  const dvec3 n = glm::normalize(dvec3(std::tan(angle), std::tan(angle) / 255.0, 1.0));
  const dvec3 l{std::sin(angle), 0, std::cos(angle)}, v{0, 0, 1};
  const dvec3 h = glm::normalize(l + v);
  const double fresnel = 0.04 + 0.96 * std::pow(1 - glm::dot(v, h), 5);
  const double n_dot_l = glm::dot(n, l);
  const double want =
      ((1 - fresnel) / pi + fresnel / pi * 0.5 / (n_dot_l + glm::dot(n, v))) * n_dot_l;
  EXPECT_NEAR(stage.render().color(4, 4).x, want, stored * 2);
}

TEST(CpuRenderer, ReadsTexelsOfBaseColourFromSrgbAndTheRestAsTheyAre) {
  Stage stage;
  stage.add_texture(Grid<u8vec4>(1, 1, u8vec4(188, 0, 255, 51)), {});
  Material m = unlit(vec4(1));
  m.base_color_texture.texture = 0;
  m.alpha_mode = AlphaMode::blend;
  stage.add(quad(stage.add_material(m)));
  const vec4 got = stage.render().color(4, 4);
  // Alpha 51 / 255 = 0.2; code 188 is 0.502886 (IEC 61966-2-1).
  const double code = std::pow((188 / 255.0 + 0.055) / 1.055, 2.4);
  expect_color(got, {0.2 * code, 0, 0.2, 0.2}, stored);
}

TEST(CpuRenderer, TakesTheMipLevelOfThePixelsFootprint) {
  // A checkerboard of single texels, 16 a pixel: level 4 of 7 is 8x8, one texel a pixel, all grey.
  Stage stage;
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

TEST(CpuRenderer, ReadsRoughnessFromGreenAndMetallicFromBlue) {
  Stage stage;
  stage.add_texture(Grid<u8vec4>(1, 1, u8vec4(7, 128, 51, 255)), {});
  Material m;
  m.base_color = {0.5f, 0.25f, 1, 1};
  m.metallic = 0.5f;
  m.metallic_roughness_texture.texture = 0;
  stage.add(quad(stage.add_material(m)));
  Light light;
  light.kind = LightKind::directional;
  stage.add_light(light);
  const vec4 got = stage.render().color(4, 4);
  // Straight on all cosines are 1: F = F0, D = 1 / (pi alpha^2), V = 1 / 4.
  const double metallic = 0.5 * 51 / 255.0, alpha = std::pow(128 / 255.0, 2);
  for (int c = 0; c < 3; ++c) {
    const double base = double(m.base_color[c]), f0 = 0.04 * (1 - metallic) + base * metallic;
    const double want = (1 - f0) * base * (1 - metallic) / pi + f0 / (4 * pi * alpha * alpha);
    EXPECT_NEAR(got[c], want, stored) << c;
  }
}

TEST(CpuRenderer, MultipliesEmissionByItsTexture) {
  Stage stage;
  stage.add_texture(Grid<u8vec4>(1, 1, u8vec4(255, 128, 0, 255)), {});
  Material m;
  m.base_color = {0, 0, 0, 1};
  m.emission = {2, 2, 2};
  m.emission_texture.texture = 0;
  stage.add(quad(stage.add_material(m)));
  // Code 128 is 0.2158605 (IEC 61966-2-1).
  expect_color(stage.render().color(4, 4), {2, 2 * 0.21586050011389926, 0, 1}, stored);
}

TEST(CpuRenderer, TransformsTheTextureCoordinatesOfTheSetThatAUseNames) {
  Stage stage;
  Grid<u8vec4> image{2, 2, u8vec4(0, 0, 0, 255)};
  image(1, 0) = u8vec4(255);
  Sampler nearest;
  nearest.mag = Filter::nearest;
  stage.add_texture(image, nearest);
  Material m = unlit(vec4(1));
  m.base_color_texture.texture = 0;
  m.base_color_texture.uv_set = 1;
  Primitive p = quad(stage.add_material(m));
  p.uvs.push_back(p.uvs[0]);
  p.uvs[0].assign(4, vec2(0.0f));
  stage.add(p);
  const auto white = [&](int x, int y) { return stage.render().color(x, y).x == 1.0f; };
  EXPECT_TRUE(white(6, 1) && !white(1, 1) && !white(1, 6) && !white(6, 6));
  // (u, v) -> (v, u): the white texel moves to the lower left.
  stage.scene.materials[0].base_color_texture.texture_from_uv =
      mat3(vec3(0, 1, 0), vec3(1, 0, 0), vec3(0, 0, 1));
  EXPECT_TRUE(white(1, 6) && !white(1, 1) && !white(6, 1) && !white(6, 6));
  // u + 1/2: to the left.
  stage.scene.materials[0].base_color_texture.texture_from_uv =
      mat3(vec3(1, 0, 0), vec3(0, 1, 0), vec3(0.5f, 0, 1));
  EXPECT_TRUE(white(1, 1) && !white(6, 1) && !white(1, 6) && !white(6, 6));
}

TEST(CpuRenderer, MirroringKeepsTheUpOfANormalMap) {
  const auto lit = [](const dmat4& place) {
    Stage stage;
    stage.add_texture(Grid<u8vec4>(1, 1, u8vec4(128, 255, 255, 255)), {});
    Material m;
    m.metallic = 0;
    m.normal_texture.texture = 0;
    stage.add(quad(stage.add_material(m)), place);
    Light light;
    light.kind = LightKind::directional;
    stage.add_light(light, glm::rotate(dmat4(1.0), -1.2, dvec3(1, 0, 0)));
    return stage.render().color(4, 4).x;
  };
  // The light comes from above, so a normal turned down would lie in the dark.
  EXPECT_GT(lit(dmat4(1.0)), 0.2f);
  // The map's x is 1/255, not 0: mirroring turns the normal by twice that.
  EXPECT_NEAR(lit(glm::scale(dmat4(1.0), dvec3(-1, 1, 1))), lit(dmat4(1.0)), 0.01);
}

TEST(CpuRenderer, TakesTheLongerSideOfAnUprightFootprint) {
  // Rows alternate in pairs: 4 texels a pixel down, 1/2 across; level 2 averages 4 rows to grey.
  Stage stage;
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
  Stage stage;
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
  Stage stage;
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
  Stage stage;
  Primitive p = quad(stage.add_material(unlit(vec4(1))));
  for (vec3& v : p.positions) v.x = v.x * 0.5f + 0.125f;  // right border at x = 5/8: mid-pixel 6
  stage.add(p);
  for (const int samples : {2, 4, 8})
    EXPECT_EQ(stage.render(8, samples).color(6, 3).x, 0.5f) << samples;
}

TEST(CpuRenderer, DrawsPointsAndLinesOnePixelWide) {
  Stage stage;
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
    Stage stage;
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
  Stage stage;
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
Stage heap() {
  Stage stage;
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
  const Stage stage = heap();
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
  const Stage stage = heap();
  double last = 0;
  cpu::render(stage.scene, stage.frame(100), {}, [&](double part) {
    EXPECT_GT(part, last);
    last = part;
  });
  EXPECT_EQ(last, 1.0);
}

TEST(CpuRenderer, RendersAnEmptySceneAsBackground) {
  Stage stage;
  Frame frame = stage.frame(5);
  frame.options.background = {1, 0.5f, 0.25f, 0.5f};
  const Picture p = cpu::render(stage.scene, frame).picture;
  for (const vec4& c : p.color) EXPECT_EQ(c, vec4(0.5f, 0.25f, 0.125f, 0.5f));
  for (const float d : p.depth) EXPECT_EQ(d, 0.0f);
}

TEST(CpuRenderer, RefusesLogarithmicDepthWithoutAFarPlane) {
  const Stage stage;
  Frame frame = stage.frame(5, 1, DepthMode::logarithmic);
  frame.far = 0;
  EXPECT_THROW(cpu::render(stage.scene, frame), std::invalid_argument);
}

}  // namespace
}  // namespace parity
