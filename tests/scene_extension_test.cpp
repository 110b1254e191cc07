#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "geometry/scene_io.h"
#include "tests/scene_loading.h"
#include "tests/shared_data.h"

namespace parity {
namespace {

using nlohmann::json;

Material with(const json& extensions) {
  return load(square_with_material({{"extensions", extensions}})).materials.at(0);
}

const json first_texture = {{"index", 0}};
const json second_set = {{"index", 0}, {"texCoord", 1}};

TEST(MaterialExtensions, AreReadInFull) {
  const Material m =
      with({{"KHR_materials_ior", {{"ior", 1.25}}},
            {"KHR_materials_specular",
             {{"specularFactor", 0.5},
              {"specularTexture", first_texture},
              {"specularColorFactor", {2, 0.5, 0}},
              {"specularColorTexture", second_set}}},
            {"KHR_materials_clearcoat",
             {{"clearcoatFactor", 0.25},
              {"clearcoatTexture", first_texture},
              {"clearcoatRoughnessFactor", 0.75},
              {"clearcoatRoughnessTexture", first_texture},
              {"clearcoatNormalTexture", {{"index", 0}, {"scale", 3}}}}},
            {"KHR_materials_sheen",
             {{"sheenColorFactor", {0.1, 0.2, 0.3}},
              {"sheenColorTexture", first_texture},
              {"sheenRoughnessFactor", 0.5},
              {"sheenRoughnessTexture", first_texture}}},
            {"KHR_materials_anisotropy",
             {{"anisotropyStrength", 0.5},
              {"anisotropyRotation", -2},
              {"anisotropyTexture", first_texture}}},
            {"KHR_materials_iridescence",
             {{"iridescenceFactor", 1},
              {"iridescenceTexture", first_texture},
              {"iridescenceIor", 2},
              {"iridescenceThicknessMinimum", 500},
              {"iridescenceThicknessMaximum", 200},
              {"iridescenceThicknessTexture", first_texture}}},
            {"KHR_materials_transmission",
             {{"transmissionFactor", 0.875}, {"transmissionTexture", first_texture}}},
            {"KHR_materials_volume",
             {{"thicknessFactor", 2},
              {"thicknessTexture", first_texture},
              {"attenuationDistance", 4},
              {"attenuationColor", {1, 0.5, 0}}}}});
  EXPECT_EQ(m.ior, 1.25f);
  EXPECT_EQ(m.specular.strength, 0.5f);
  EXPECT_EQ(m.specular.color, vec3(2, 0.5f, 0));
  EXPECT_EQ(m.specular.color_texture.uv_set, 1);
  EXPECT_EQ(m.clearcoat.factor, 0.25f);
  EXPECT_EQ(m.clearcoat.roughness, 0.75f);
  EXPECT_EQ(m.clearcoat.normal_scale, 3);
  EXPECT_EQ(m.sheen.color, vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(m.sheen.roughness, 0.5f);
  EXPECT_EQ(m.anisotropy.strength, 0.5f);
  EXPECT_EQ(m.anisotropy.rotation, -2);
  EXPECT_EQ(m.iridescence.factor, 1);
  EXPECT_EQ(m.iridescence.ior, 2);
  EXPECT_EQ(m.iridescence.thickness_minimum, 500);
  EXPECT_EQ(m.iridescence.thickness_maximum, 200);
  EXPECT_EQ(m.transmission.factor, 0.875f);
  EXPECT_EQ(m.transmission.thickness, 2);
  EXPECT_EQ(m.transmission.attenuation_distance, 4);
  EXPECT_EQ(m.transmission.attenuation_color, vec3(1, 0.5f, 0));
  for (std::size_t role = std::size_t(TextureRole::specular); role < texture_role_count; ++role)
    EXPECT_EQ(textures_of(m)[role]->texture, 0) << role;
}

TEST(MaterialExtensions, HaveTheDefaultsOfTheirTexts) {
  const Material m = with({{"KHR_materials_ior", json::object()},
                           {"KHR_materials_iridescence", json::object()},
                           {"KHR_materials_volume", json::object()},
                           {"KHR_materials_specular", json::object()}});
  EXPECT_EQ(m.ior, 1.5f);
  EXPECT_EQ(m.specular.strength, 1);
  EXPECT_EQ(m.specular.color, vec3(1));
  EXPECT_EQ(m.iridescence.ior, 1.3f);
  EXPECT_EQ(m.iridescence.thickness_minimum, 100);
  EXPECT_EQ(m.iridescence.thickness_maximum, 400);
  EXPECT_TRUE(std::isinf(m.transmission.attenuation_distance));
  for (const TextureUse* use : textures_of(m)) EXPECT_EQ(use->texture, -1);
}

TEST(MaterialExtensions, RefuseWhatCannotBeMeant) {
  const auto refuses = [](const char* name, const json& extension) {
    const std::string message = refusal(square_with_material(
        {{"extensions", {{std::string("KHR_materials_") + name, extension}}}}));
    EXPECT_NE(message.find("materials[0].extensions.KHR_materials_"), std::string::npos)
        << name << ": " << message;
  };
  refuses("ior", {{"ior", 0.5}});
  refuses("ior", {{"ior", -1}});
  refuses("specular", {{"specularFactor", 2}});
  refuses("specular", {{"specularColorFactor", {1, 1}}});
  refuses("clearcoat", {{"clearcoatFactor", -0.1}});
  refuses("clearcoat", {{"clearcoatTexture", {{"index", 9}}}});
  refuses("sheen", {{"sheenRoughnessFactor", "1"}});
  refuses("sheen", {{"sheenColorFactor", {1, 1, 2}}});
  refuses("anisotropy", {{"anisotropyStrength", 1.5}});
  refuses("iridescence", {{"iridescenceIor", 0.9}});
  refuses("iridescence", {{"iridescenceThicknessMaximum", -1}});
  refuses("transmission", {{"transmissionFactor", true}});
  refuses("volume", {{"attenuationDistance", 0}});
  refuses("volume", {{"thicknessFactor", -1}});
  refuses("volume", {{"attenuationColor", 1}});
}

TEST(MaterialExtensions, BringTangentsAlongWhereTheyTurnSomething) {
  const auto tangents = [](const json& extensions) {
    return first_primitive(load(square_with_material({{"extensions", extensions}}))).tangents;
  };
  EXPECT_TRUE(tangents({{"KHR_materials_sheen", {{"sheenColorTexture", first_texture}}}}).empty());
  EXPECT_EQ(tangents({{"KHR_materials_anisotropy", {{"anisotropyStrength", 1}}}}).at(0),
            vec4(1, 0, 0, 1));
  EXPECT_EQ(
      tangents({{"KHR_materials_clearcoat", {{"clearcoatNormalTexture", first_texture}}}}).at(0),
      vec4(1, 0, 0, 1));
}

TEST(MaterialExtensions, AreThereInTheSharedScenes) {
  const auto load_shared = [](const char* file) {
    const auto path = shared_data(std::string("data/gltf/") + file);
    return path ? load_scene(*path) : Scene{};
  };
  if (!shared_data("data/gltf")) GTEST_SKIP() << "no shared data";
  const auto any = [&](const char* file, auto&& holds) {
    for (const Material& m : load_shared(file).materials)
      if (holds(m)) return true;
    return false;
  };
  EXPECT_TRUE(any("ClearCoatTest/ClearCoatTest.gltf",
                  [](const Material& m) { return m.clearcoat.normal_texture.texture >= 0; }));
  EXPECT_TRUE(any("MaterialExtSphere/sphere.gltf",
                  [](const Material& m) { return m.sheen.roughness_texture.texture >= 0; }));
  EXPECT_TRUE(any("AnisotropyBarnLamp/AnisotropyBarnLamp.gltf",
                  [](const Material& m) { return m.anisotropy.strength > 0; }));
  EXPECT_TRUE(any("Transmission/KHR_materials_transmission.gltf",
                  [](const Material& m) { return m.transmission.texture.texture >= 0; }));
  EXPECT_TRUE(
      any("Volume/16_volume.gltf", [](const Material& m) { return m.transmission.thickness > 0; }));
}

}  // namespace
}  // namespace parity
