#include <gtest/gtest.h>

#include <cmath>

#include "cpu_reference/shading/brdf.h"
#include "geometry/albedo_table.h"
#include "tests/small_scene.h"

namespace parity {
namespace {

TEST(CpuShading, GivesTheAnalyticRadianceOfARoughQuadUnderADirectionalLight) {
  const double angle = 0.6;
  SmallScene stage;
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

TEST(CpuShading, ShowsAWhiteDielectricAsItsUniformEnvironment) {
  for (const float roughness : {0.0f, 0.3f, 1.0f}) {
    SmallScene stage;
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

TEST(CpuShading, OcclusionDimsTheEnvironmentByItsStrength) {
  SmallScene stage;
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

TEST(CpuShading, PointLightFallsOffWithTheSquareOfTheDistanceInsideItsRange) {
  SmallScene stage;
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
  SmallScene dark = stage;
  dark.scene.lights[0] = light;
  EXPECT_EQ(dark.render().color(4, 3).x, 0.0f);
}

TEST(CpuShading, SpotLightFadesBetweenItsCones) {
  SmallScene stage;
  Material m;
  m.metallic = 0;
  stage.add(quad(stage.add_material(m)));
  Light light;
  light.kind = LightKind::spot;
  light.inner_cone_angle = 0.2f;
  light.outer_cone_angle = 0.6f;
  const dmat4 above = glm::translate(dmat4(1.0), dvec3(0.125, 0.125, 0.0));
  const auto middle = [&](double tilt) {
    SmallScene s = stage;
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

TEST(CpuShading, AddsEmissionAndLeavesUnlitMaterialsAlone) {
  SmallScene stage;
  Material glowing;
  glowing.base_color = vec4(0, 0, 0, 1);
  glowing.emission = {3, 2, 1};
  stage.add(quad(stage.add_material(glowing)));
  stage.add(quad(stage.add_material(unlit({0.1f, 0.2f, 0.3f, 1})), -0.9f, 0.5f));
  const Picture picture = stage.render();
  expect_color(picture.color(0, 0), {3, 2, 1, 1}, 0);
  expect_color(picture.color(4, 4), {0.1f, 0.2f, 0.3f, 1}, 0);
}

TEST(CpuShading, LightsTheBackOfDoubleSidedMaterialsAsTheFront) {
  Light light;
  light.kind = LightKind::directional;
  const auto lit = [&](const dmat4& place, bool mapped) {
    SmallScene stage;
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

TEST(CpuShading, NormalMapTurnsTheNormalTowardTheTangent) {
  // Texel (255, 128 - 0.5, 255) / 255 with scale s is (s, ~0, 1): a turn by atan(s) toward +x.
  const double angle = 0.5;
  SmallScene stage;
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

TEST(CpuShading, ReadsTexelsOfBaseColourFromSrgbAndTheRestAsTheyAre) {
  SmallScene stage;
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

TEST(CpuShading, ReadsRoughnessFromGreenAndMetallicFromBlue) {
  SmallScene stage;
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
    const double once = 0.96 * base * (1 - metallic) / pi + f0 / (4 * pi * alpha * alpha);
    // What several bounces add, of the metal: Kulla & Conty's lobe, straight on.
    const dvec3 albedo = cpu::albedo_at(albedo_table(), 1, 128 / 255.0);
    const double lost = 1 - albedo.x - albedo.y, f = (1 + 20 * base) / 21;
    const double more =
        lost * lost / (pi * (1 - albedo.z)) * f * f * albedo.z / (1 - f * (1 - albedo.z));
    EXPECT_NEAR(got[c], once + metallic * more, stored) << c;
  }
}

TEST(CpuShading, MultipliesEmissionByItsTexture) {
  SmallScene stage;
  stage.add_texture(Grid<u8vec4>(1, 1, u8vec4(255, 128, 0, 255)), {});
  Material m;
  m.base_color = {0, 0, 0, 1};
  m.emission = {2, 2, 2};
  m.emission_texture.texture = 0;
  stage.add(quad(stage.add_material(m)));
  // Code 128 is 0.2158605 (IEC 61966-2-1).
  expect_color(stage.render().color(4, 4), {2, 2 * 0.21586050011389926, 0, 1}, stored);
}

TEST(CpuShading, TransformsTheTextureCoordinatesOfTheSetThatAUseNames) {
  SmallScene stage;
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

TEST(CpuShading, MirroringKeepsTheUpOfANormalMap) {
  const auto lit = [](const dmat4& place) {
    SmallScene stage;
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

TEST(CpuShading, ScalingAnObjectKeepsItsNormalMap) {
  const auto lit = [](double scale) {
    SmallScene stage;
    stage.add_texture(Grid<u8vec4>(1, 1, u8vec4(230, 90, 200, 255)), {});
    Material m;
    m.metallic = 0;
    m.normal_texture.texture = 0;
    stage.add(quad(stage.add_material(m), float(-1 / scale), float(1 / scale)),
              glm::scale(dmat4(1.0), dvec3(scale)));
    Light light;
    light.kind = LightKind::directional;
    stage.add_light(light, turned(0.5));
    return stage.render().color(4, 4).x;
  };
  EXPECT_GT(lit(1), 0.1f);
  EXPECT_NEAR(lit(0.125), lit(1), stored);
  EXPECT_NEAR(lit(8), lit(1), stored);
}

}  // namespace
}  // namespace parity
