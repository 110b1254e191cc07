#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/scene_loading.h"

namespace parity {
namespace {

using nlohmann::json;

TEST(SceneIo, ReadsCameras) {
  GltfBuilder builder;
  builder.root["cameras"] = {
      {{"type", "perspective"}, {"name", "open"}, {"perspective", {{"yfov", 1}, {"znear", 0.5}}}},
      {{"type", "orthographic"},
       {"orthographic", {{"xmag", 3}, {"ymag", 2}, {"znear", 0}, {"zfar", 9}}}}};
  builder.root["nodes"] = {{{"camera", 1}}};
  const Scene scene = load(builder);
  ASSERT_EQ(scene.cameras.size(), 2u);
  EXPECT_EQ(scene.cameras[0].name, "open");
  EXPECT_EQ(scene.cameras[0].vertical_fov, 1);
  EXPECT_EQ(scene.cameras[0].near, 0.5);
  EXPECT_FALSE(scene.cameras[0].far);
  EXPECT_FALSE(scene.cameras[0].aspect);
  EXPECT_TRUE(scene.cameras[1].orthographic);
  EXPECT_EQ(scene.cameras[1].x_magnification, 3);
  EXPECT_EQ(scene.cameras[1].y_magnification, 2);
  EXPECT_EQ(scene.cameras[1].far, 9);
  EXPECT_EQ(scene.nodes.at(0).camera, 1);
}

TEST(SceneIo, ReadsLightsAndTheirDefaults) {
  GltfBuilder builder;
  builder.root["extensionsUsed"] = {"KHR_lights_punctual"};
  builder.root["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "directional"}, {"color", {1, 0.5, 0}}, {"intensity", 3}},
      {{"type", "spot"}, {"range", 7}, {"spot", {{"innerConeAngle", 0.25}}}},
      {{"type", "point"}}};
  builder.root["nodes"] = {{{"extensions", {{"KHR_lights_punctual", {{"light", 2}}}}}}};
  const Scene scene = load(builder);
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.lights[0].kind, LightKind::directional);
  EXPECT_EQ(scene.lights[0].color, vec3(1, 0.5f, 0));
  EXPECT_EQ(scene.lights[0].intensity, 3);
  EXPECT_EQ(scene.lights[1].range, 7);
  EXPECT_EQ(scene.lights[1].inner_cone_angle, 0.25f);
  EXPECT_FLOAT_EQ(scene.lights[1].outer_cone_angle, float(std::numbers::pi / 4));
  EXPECT_EQ(scene.lights[2].color, vec3(1));
  EXPECT_TRUE(std::isinf(scene.lights[2].range));
  EXPECT_EQ(scene.nodes.at(0).light, 2);
}

TEST(SceneIo, ReadsMaterials) {
  const Scene scene =
      load(square_with_material({{"pbrMetallicRoughness",
                                  {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}},
                                   {"metallicFactor", 0.25},
                                   {"roughnessFactor", 0.5}}},
                                 {"emissiveFactor", {1, 0.5, 0}},
                                 {"alphaMode", "MASK"},
                                 {"alphaCutoff", 0.75},
                                 {"doubleSided", true},
                                 {"extensions",
                                  {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}},
                                   {"KHR_materials_unlit", json::object()}}}}));
  const Material& m = scene.materials.at(0);
  EXPECT_EQ(m.base_color, vec4(0.1f, 0.2f, 0.3f, 0.4f));
  EXPECT_EQ(m.metallic, 0.25f);
  EXPECT_EQ(m.roughness, 0.5f);
  EXPECT_EQ(m.emission, vec3(4, 2, 0));
  EXPECT_EQ(m.alpha_mode, AlphaMode::mask);
  EXPECT_EQ(m.alpha_cutoff, 0.75f);
  EXPECT_TRUE(m.double_sided);
  EXPECT_TRUE(m.unlit);
}

TEST(SceneIo, KeepsOnlyTheTexturesThatMaterialsUse) {
  const Scene scene = load(square_with_material({{"emissiveTexture", {{"index", 1}}}}));
  ASSERT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.materials.at(0).emission_texture.texture, 0);
  EXPECT_EQ(scene.textures[0].sampler.wrap_u, Wrap::clamp_to_edge);
  EXPECT_EQ(scene.textures[0].sampler.wrap_v, Wrap::mirrored_repeat);
  EXPECT_EQ(scene.textures[0].sampler.min, Filter::nearest);
  EXPECT_FALSE(scene.textures[0].sampler.mip);
  EXPECT_EQ(scene.textures[0].sampler.mag, Filter::linear);
  EXPECT_EQ(scene.images.at(0).width(), 4);
}

TEST(SceneIo, TransformsTextureCoordinates) {
  // The extension's example: the lower left quadrant of the picture, turned clockwise.
  const json transform = {{"offset", {0, 1}},
                          {"rotation", std::numbers::pi / 2},
                          {"scale", {0.5, 0.5}},
                          {"texCoord", 1}};
  const Scene scene = load(square_with_material(
      {{"emissiveTexture",
        {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}}}}));
  const TextureUse& use = scene.materials.at(0).emission_texture;
  EXPECT_EQ(use.uv_set, 1);
  const auto at = [&](float u, float v) { return vec2(use.texture_from_uv * vec3(u, v, 1)); };
  const float rounding = 4 * 0x1p-24f;  // a product and a sum of numbers up to 1, cosine of pi/2
  EXPECT_NEAR(glm::length(at(0, 0) - vec2(0, 1)), 0, rounding);
  EXPECT_NEAR(glm::length(at(1, 0) - vec2(0, 0.5f)), 0, rounding);
  EXPECT_NEAR(glm::length(at(0, 1) - vec2(0.5f, 1)), 0, rounding);
  ASSERT_EQ(first_primitive(scene).uvs.size(), 2u);
  EXPECT_TRUE(first_primitive(scene).uvs[0].empty());
}

TEST(SceneIo, GivesTheDefaultConversionOfSpecularGlossiness) {
  const auto convert = [](const json& extension) {
    return load(square_with_material(
                    {{"extensions", {{"KHR_materials_pbrSpecularGlossiness", extension}}}}))
        .materials.at(0);
  };
  const Material gold = convert({{"diffuseFactor", {0, 0, 0, 1}},
                                 {"specularFactor", {1, 0.8, 0.3}},
                                 {"glossinessFactor", 0.75}});
  EXPECT_FLOAT_EQ(gold.roughness, 0.25f);
  EXPECT_FLOAT_EQ(gold.metallic, 1);  // no diffuse: a metal of that colour
  EXPECT_NEAR(gold.base_color.y, 0.8f, 1e-6f);
  const Material plastic =
      convert({{"diffuseFactor", {0.5, 0.5, 0.5, 1}}, {"specularFactor", {0.04, 0.04, 0.04}}});
  EXPECT_FLOAT_EQ(plastic.metallic, 0);  // 4 % is what every dielectric has
  EXPECT_NEAR(plastic.base_color.x, 0.5f, 1e-6f);
}

TEST(SceneIo, MakesTangentsOnlyForNormalMaps) {
  const Scene plain = load(square_with_material({{"emissiveTexture", {{"index", 0}}}}));
  EXPECT_TRUE(first_primitive(plain).tangents.empty());
  const Scene mapped = load(square_with_material({{"normalTexture", {{"index", 0}}}}));
  ASSERT_EQ(first_primitive(mapped).tangents.size(), first_primitive(mapped).positions.size());
  for (const vec4& tangent : first_primitive(mapped).tangents) EXPECT_EQ(tangent, vec4(1, 0, 0, 1));
}

}  // namespace
}  // namespace parity
