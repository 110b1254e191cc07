#include "geometry/scene_io.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "geometry/input_error.h"
#include "tests/gltf_builder.h"

namespace parity {
namespace {

using nlohmann::json;

Scene load(const GltfBuilder& builder) { return load_scene_from_memory(builder.glb(), "test.glb"); }

/// The message with which a file is refused; empty: it was not.
std::string refusal(const GltfBuilder& builder) {
  try {
    load(builder);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

const Primitive& first_primitive(const Scene& scene) { return scene.meshes.at(0).primitives.at(0); }

//  3---2
//  | / |    in the plane z = 0
//  0---1
const std::vector<float> square{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

GltfBuilder square_with_indices(const std::vector<std::uint16_t>& indices, int mode) {
  GltfBuilder builder;
  const int position = builder.accessor(square, "VEC3");
  const int index = builder.accessor(indices, "SCALAR");
  builder.show({{"attributes", {{"POSITION", position}}}, {"indices", index}, {"mode", mode}});
  return builder;
}

GltfBuilder plain_square() { return square_with_indices({0, 1, 2, 0, 2, 3}, 4); }

/// Corners in the order in which they are drawn.
std::vector<vec3> corners(const Primitive& primitive) {
  std::vector<vec3> list;
  for (std::uint32_t index : primitive.indices) list.push_back(primitive.positions[index]);
  return list;
}

const vec3 p0{0, 0, 0}, p1{1, 0, 0}, p2{1, 1, 0}, p3{0, 1, 0};

TEST(SceneIo, AppliesScaleThenRotationThenTranslation) {
  GltfBuilder builder = plain_square();
  const double half = std::sqrt(0.5);  // a quarter turn about z takes x to y
  builder.root["nodes"][0].update(
      {{"translation", {10, 20, 30}}, {"rotation", {0, 0, half, half}}, {"scale", {2, 3, 4}}});
  const dmat4 m = load(builder).nodes.at(0).parent_from_node;
  const dvec4 got = m * dvec4(1, 1, 1, 1);  // scaled (2, 3, 4), turned (-3, 2, 4)
  EXPECT_NEAR(glm::length(got - dvec4(7, 22, 34, 1)), 0, 1e-14 * 40);
}

TEST(SceneIo, ReadsAMatrixColumnByColumn) {
  GltfBuilder builder = plain_square();
  builder.root["nodes"][0]["matrix"] = {1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 0, 10, 11, 12, 1};
  const dmat4 m = load(builder).nodes.at(0).parent_from_node;
  EXPECT_EQ(m[0], dvec4(1, 2, 3, 0));
  EXPECT_EQ(m[3], dvec4(10, 11, 12, 1));
}

TEST(SceneIo, SortsParentsBeforeChildren) {
  GltfBuilder builder = plain_square();
  builder.root["nodes"] = {{{"name", "leaf"}, {"mesh", 0}, {"translation", {0, 0, 1}}},
                           {{"name", "root"}, {"children", {2}}, {"translation", {100, 0, 0}}},
                           {{"name", "middle"}, {"children", {0}}, {"translation", {0, 10, 0}}}};
  builder.root["scenes"] = {{{"nodes", {1}}}};
  const Scene scene = load(builder);
  ASSERT_EQ(scene.nodes.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(scene.nodes[i].parent, int(i));
  EXPECT_EQ(scene.nodes[2].name, "leaf");
  EXPECT_EQ(dvec3(world_from_nodes(scene)[2][3]), dvec3(100, 10, 1));
}

TEST(SceneIo, LeavesOutNodesOfOtherScenes) {
  GltfBuilder builder = plain_square();
  builder.root["nodes"] = {{{"name", "shown"}}, {{"name", "hidden"}, {"mesh", 0}}};
  builder.root["scenes"] = {{{"nodes", {1}}}, {{"nodes", {0}}}};
  builder.root["scene"] = 1;
  const Scene scene = load(builder);
  ASSERT_EQ(scene.nodes.size(), 1u);
  EXPECT_EQ(scene.nodes[0].name, "shown");
  EXPECT_TRUE(scene.meshes.empty());
}

template <typename Index>
void expect_index_type_works() {
  GltfBuilder builder;
  const int position = builder.accessor(square, "VEC3");
  const int index = builder.accessor(std::vector<Index>{0, 1, 2, 0, 2, 3}, "SCALAR");
  builder.show({{"attributes", {{"POSITION", position}}}, {"indices", index}});
  EXPECT_EQ(corners(first_primitive(load(builder))), (std::vector{p0, p1, p2, p0, p2, p3}));
}

TEST(SceneIo, ReadsIndicesOfAllTypes) {
  expect_index_type_works<std::uint8_t>();
  expect_index_type_works<std::uint16_t>();
  expect_index_type_works<std::uint32_t>();
}

TEST(SceneIo, CountsVerticesWithoutIndices) {
  GltfBuilder builder;
  builder.show({{"attributes", {{"POSITION", builder.accessor(square, "VEC3")}}}, {"mode", 1}});
  EXPECT_EQ(corners(first_primitive(load(builder))), (std::vector{p0, p1, p2, p3}));
}

TEST(SceneIo, ExpandsLoopsStripsAndFans) {
  const auto drawn = [](int mode) {
    return corners(first_primitive(load(square_with_indices({0, 1, 2, 3}, mode))));
  };
  EXPECT_EQ(drawn(0), (std::vector{p0, p1, p2, p3}));
  EXPECT_EQ(drawn(1), (std::vector{p0, p1, p2, p3}));
  EXPECT_EQ(drawn(2), (std::vector{p0, p1, p1, p2, p2, p3, p3, p0}));
  EXPECT_EQ(drawn(3), (std::vector{p0, p1, p1, p2, p2, p3}));
  EXPECT_EQ(drawn(5), (std::vector{p0, p1, p2, p1, p3, p2}));  // p_i = {v_i, v_i+1+i%2, v_i+2-i%2}
  EXPECT_EQ(drawn(6), (std::vector{p1, p2, p0, p2, p3, p0}));  // p_i = {v_i+1, v_i+2, v_0}
}

TEST(SceneIo, LeavesOutVerticesThatNothingNames) {
  const Primitive primitive = first_primitive(load(square_with_indices({3, 1, 3, 1}, 1)));
  EXPECT_EQ(primitive.positions, (std::vector{p1, p3}));
  EXPECT_EQ(primitive.indices, (std::vector<std::uint32_t>{1, 0, 1, 0}));
}

TEST(SceneIo, MakesFlatNormalsWhereThereAreNone) {
  GltfBuilder builder;  // a roof: two triangles on a common ridge 0-1, turned by 90 degrees
  const int position =
      builder.accessor(std::vector<float>{0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1}, "VEC3");
  const int index = builder.accessor(std::vector<std::uint16_t>{0, 2, 1, 0, 1, 3}, "SCALAR");
  builder.show({{"attributes", {{"POSITION", position}}}, {"indices", index}});
  const Primitive primitive = first_primitive(load(builder));
  ASSERT_EQ(primitive.positions.size(), 6u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(primitive.normals[i], vec3(0, 0, 1));
  for (std::size_t i = 3; i < 6; ++i) EXPECT_EQ(primitive.normals[i], vec3(1, 0, 0));
}

template <typename T>
std::vector<vec3> read_positions(const std::vector<T>& values, bool normalized) {
  GltfBuilder builder;
  const int position = builder.accessor(values, "VEC3", {{"normalized", normalized}});
  builder.show({{"attributes", {{"POSITION", position}}}, {"mode", 0}});
  return first_primitive(load(builder)).positions;
}

TEST(SceneIo, DividesNormalizedIntegersByTheirLargestValue) {
  EXPECT_EQ(read_positions<std::int8_t>({127, -127, -128}, true), (std::vector{vec3(1, -1, -1)}));
  EXPECT_EQ(read_positions<std::uint8_t>({255, 51, 0}, true), (std::vector{vec3(1, 0.2f, 0)}));
  EXPECT_EQ(read_positions<std::int16_t>({32767, -32768, 0}, true), (std::vector{vec3(1, -1, 0)}));
  EXPECT_EQ(read_positions<std::uint16_t>({65535, 13107, 0}, true),
            (std::vector{vec3(1, 0.2f, 0)}));
}

TEST(SceneIo, ReadsQuantizedIntegersAsTheyAre) {
  EXPECT_EQ(read_positions<std::int16_t>({300, -32768, 7}, false),
            (std::vector{vec3(300, -32768, 7)}));
}

TEST(SceneIo, SteppsOverInterleavedValues) {
  GltfBuilder builder;
  const int view = builder.view(std::vector<float>{0, 0, 0, 9, 1, 0, 0, 9, 1, 1, 0, 9});
  builder.root["bufferViews"][std::size_t(view)]["byteStride"] = 16;
  builder.root["accessors"] = {
      {{"bufferView", view}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}}};
  builder.show({{"attributes", {{"POSITION", 0}}}, {"mode", 0}});
  EXPECT_EQ(first_primitive(load(builder)).positions, (std::vector{p0, p1, p2}));
}

TEST(SceneIo, ReplacesSparseElements) {
  GltfBuilder builder = plain_square();
  const int indices = builder.view(std::vector<std::uint8_t>{1, 2});
  const int values = builder.view(std::vector<float>{5, 0, 0, 6, 6, 0});
  builder.root["accessors"][0]["sparse"] = {
      {"count", 2},
      {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
      {"values", {{"bufferView", values}}}};
  EXPECT_EQ(corners(first_primitive(load(builder))),
            (std::vector{p0, vec3(5, 0, 0), vec3(6, 6, 0), p0, vec3(6, 6, 0), p3}));
}

TEST(SceneIo, RefusesSparseIndicesPastTheEndAndOutOfOrder) {
  const auto refuses = [](const std::vector<std::uint8_t>& places) {
    GltfBuilder builder = plain_square();  // four vertices
    const int indices = builder.view(places);
    const int values = builder.view(std::vector<float>{5, 0, 0, 6, 6, 0});
    builder.root["accessors"][0]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
        {"values", {{"bufferView", values}}}};
    return refusal(builder) != "";
  };
  EXPECT_FALSE(refuses({0, 3}));
  EXPECT_TRUE(refuses({0, 4}));
  EXPECT_TRUE(refuses({3, 0}));
  EXPECT_TRUE(refuses({2, 2}));
}

TEST(SceneIo, ReplacesSparseElementsOfZeros) {
  GltfBuilder builder;
  const int indices = builder.view(std::vector<std::uint16_t>{2});
  const int values = builder.view(std::vector<float>{1, 2, 3});
  builder.root["accessors"] = {{{"componentType", 5126},
                                {"count", 3},
                                {"type", "VEC3"},
                                {"sparse",
                                 {{"count", 1},
                                  {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                  {"values", {{"bufferView", values}}}}}}};
  builder.show({{"attributes", {{"POSITION", 0}}}, {"mode", 0}});
  EXPECT_EQ(first_primitive(load(builder)).positions, (std::vector{p0, p0, vec3(1, 2, 3)}));
}

TEST(SceneIo, ReadsVertexColoursOfThreeAndFourComponents) {
  const auto colors = [](auto values, const std::string& type, const json& more) {
    GltfBuilder builder;
    const int position = builder.accessor(std::vector<float>{0, 0, 0}, "VEC3");
    const int color = builder.accessor(values, type, more);
    builder.show({{"attributes", {{"POSITION", position}, {"COLOR_0", color}}}, {"mode", 0}});
    return first_primitive(load(builder)).colors.at(0);
  };
  const json normalized = {{"normalized", true}};
  EXPECT_EQ(colors(std::vector<float>{0.5f, 0.25f, 1}, "VEC3", json::object()),
            vec4(0.5f, 0.25f, 1, 1));
  EXPECT_EQ(colors(std::vector<std::uint8_t>{255, 51, 0, 102}, "VEC4", normalized),
            vec4(1, 0.2f, 0, 0.4f));
  EXPECT_EQ(colors(std::vector<std::uint16_t>{65535, 13107, 0}, "VEC3", normalized),
            vec4(1, 0.2f, 0, 1));
}

TEST(SceneIo, AppliesMorphTargetsOfTheMeshUnlessTheNodeHasItsOwn) {
  GltfBuilder builder;
  const int position = builder.accessor(std::vector<float>{1, 2, 3}, "VEC3");
  const int up = builder.accessor(std::vector<float>{0, 1, 0}, "VEC3");
  const int aside = builder.accessor(std::vector<float>{1, 0, 0}, "VEC3");
  builder.show({{"attributes", {{"POSITION", position}}},
                {"mode", 0},
                {"targets", {{{"POSITION", up}}, {{"POSITION", aside}}}}});
  EXPECT_EQ(first_primitive(load(builder)).positions[0], vec3(1, 2, 3));
  builder.root["meshes"][0]["weights"] = {0.5, 0.25};
  EXPECT_EQ(first_primitive(load(builder)).positions[0], vec3(1.25f, 2.5f, 3));
  builder.root["nodes"][0]["weights"] = {0, -2};
  EXPECT_EQ(first_primitive(load(builder)).positions[0], vec3(-1, 2, 3));
}

TEST(SceneIo, BlendsJointsIntoTheWorldAndForgetsTheNodeOfTheMesh) {
  GltfBuilder builder;
  const int position = builder.accessor(std::vector<float>{1, 0, 0, 1, 0, 0}, "VEC3");
  const int joints = builder.accessor(std::vector<std::uint8_t>{0, 1, 0, 0, 1, 0, 0, 0}, "VEC4");
  const int weights = builder.accessor(std::vector<float>{0.75f, 0.25f, 0, 0, 1, 0, 0, 0}, "VEC4");
  std::vector<float> inverse_bind(32, 0.0f);  // both move by -1 in y
  for (std::size_t m = 0; m < 2; ++m)
    for (std::size_t i = 0; i < 4; ++i) inverse_bind[16 * m + 5 * i] = 1;
  inverse_bind[13] = inverse_bind[29] = -1;
  const int matrices = builder.accessor(inverse_bind, "MAT4");
  builder.show(
      {{"attributes", {{"POSITION", position}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}},
       {"mode", 0}});
  builder.root["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {1000, 0, 0}}},
                           {{"translation", {0, 0, 8}}, {"children", {2}}},
                           {{"scale", {2, 2, 2}}}};
  builder.root["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", matrices}}};
  builder.root["scenes"] = {{{"nodes", {0, 1}}}};
  const Scene scene = load(builder);
  // Joint 0: (1, -1, 8); joint 1: (2, -2, 8).
  EXPECT_EQ(first_primitive(scene).positions,
            (std::vector{vec3(1.25f, -1.25f, 8), vec3(2, -2, 8)}));
  const Node& node = scene.nodes.back();
  EXPECT_EQ(node.mesh, 0);
  EXPECT_EQ(node.parent, -1);
  EXPECT_EQ(node.parent_from_node, dmat4(1.0));
}

TEST(SceneIo, ScalesJointWeightsToASumOfOne) {
  GltfBuilder builder;
  const int position = builder.accessor(std::vector<float>{1, 2, 3}, "VEC3");
  const int joints = builder.accessor(std::vector<std::uint16_t>{0, 0, 0, 0}, "VEC4");
  const int weights = builder.accessor(std::vector<float>{0.25f, 0.25f, 0, 0}, "VEC4");
  builder.show(
      {{"attributes", {{"POSITION", position}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}},
       {"mode", 0}});
  builder.root["nodes"] = {{{"mesh", 0}, {"skin", 0}}, {{"translation", {0, 0, 4}}}};
  builder.root["skins"] = {{{"joints", {1}}}};
  const Scene scene = load(builder);
  EXPECT_EQ(first_primitive(scene).positions, std::vector{vec3(1, 2, 7)});
  EXPECT_EQ(scene.notes.size(), 1u);
}

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

/// A 1 x 1 PNG, so that textures have something to show.
const char* const pixel_uri =
    "data:image/"
    "png;base64,iVBORw0KGgoAAAANSUhEUgAAAAQAAAAECAIAAAAmkwkpAAAAM0lEQVR42mNgUPXKn7LzHrOGb"
    "9F0BjC55yGbdkDpLAYwuf8Jp15wxVwGMHnoOY9hWPUCANhzEwEv1og0AAAAAElFTkSuQmCC";

GltfBuilder square_with_material(const json& material) {
  GltfBuilder builder = plain_square();
  const int uv = builder.accessor(std::vector<float>{0, 1, 1, 1, 1, 0, 0, 0}, "VEC2");
  const int half = builder.accessor(std::vector<float>{0, .5f, .5f, .5f, .5f, 0, 0, 0}, "VEC2");
  builder.root["meshes"][0]["primitives"][0]["attributes"].update(
      {{"TEXCOORD_0", uv}, {"TEXCOORD_1", half}});
  builder.root["meshes"][0]["primitives"][0]["material"] = 0;
  builder.root["images"] = {{{"uri", pixel_uri}}};
  builder.root["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"minFilter", 9728}}};
  builder.root["textures"] = {{{"source", 0}}, {{"source", 0}, {"sampler", 0}}};
  builder.root["materials"] = json::array({material});
  return builder;
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

TEST(SceneIo, PlacesInstancesAsChildren) {
  GltfBuilder builder = plain_square();
  const int translation = builder.accessor(std::vector<float>{1, 0, 0, 0, 2, 0}, "VEC3");
  const int scale = builder.accessor(std::vector<float>{1, 1, 1, 3, 3, 3}, "VEC3");
  builder.root["nodes"][0]["translation"] = {0, 0, 5};
  builder.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", translation}, {"SCALE", scale}};
  builder.root["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  const Scene scene = load(builder);
  ASSERT_EQ(scene.nodes.size(), 3u);
  EXPECT_EQ(scene.nodes[0].mesh, -1);
  EXPECT_EQ(scene.nodes[2].mesh, 0);
  const dmat4 world = world_from_nodes(scene)[2];
  EXPECT_EQ(dvec3(world * dvec4(1, 1, 1, 1)), dvec3(3, 5, 8));
}

TEST(SceneIo, NotesWhatItIgnores) {
  GltfBuilder builder = plain_square();
  builder.root["extensionsUsed"] = {"ACME_warp"};
  const Scene scene = load(builder);
  ASSERT_EQ(scene.notes.size(), 1u);
  EXPECT_NE(scene.notes[0].find("ACME_warp"), std::string::npos);
}

TEST(SceneIo, RefusesARequiredExtensionByName) {
  GltfBuilder builder = plain_square();
  builder.root["extensionsRequired"] = {"ACME_warp"};
  EXPECT_EQ(refusal(builder),
            "test.glb: extensionsRequired: extension \"ACME_warp\" is not supported");
}

TEST(SceneIo, NamesPlaceValueAndExpectation) {
  GltfBuilder builder = plain_square();
  builder.root["accessors"][0]["bufferView"] = 99;
  EXPECT_EQ(refusal(builder),
            "test.glb: accessors[0].bufferView is 99, but there are 2 bufferViews");
}

TEST(SceneIo, RefusesWhatCannotBeMeant) {
  const auto refuses = [](const char* pointer, const json& value) {
    GltfBuilder builder = square_with_material({{"normalTexture", {{"index", 0}}}});
    builder.root[json::json_pointer(pointer)] = value;
    const std::string message = refusal(builder);
    EXPECT_NE(message, "") << pointer << " = " << value;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  };
  refuses("/asset/version", "1.0");
  refuses("/asset/minVersion", "2.1");
  refuses("/nodes/0/children", {0});
  refuses("/nodes/0/matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0});
  refuses("/nodes/0", {{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
                       {"translation", {1, 0, 0}}});
  refuses("/nodes/0/translation", {1e39, 0, 0});
  refuses("/nodes/0/mesh", -1);
  refuses("/nodes/0/mesh", 0.5);
  refuses("/scenes/0/nodes", {0, 0});
  refuses("/accessors/0/type", "VEC5");
  refuses("/accessors/0/type", "VEC2");
  refuses("/accessors/0/byteOffset", 4);
  refuses("/accessors/0/byteOffset", 9007199254740992.0);
  refuses("/accessors/1/componentType", 5126);
  refuses("/accessors/1/count", 4294967296.0);
  refuses("/bufferViews/0/byteLength", 1e15);
  refuses("/meshes/0/primitives/0/mode", 7);
  refuses("/meshes/0/primitives/0/attributes/NORMAL", 2);
  refuses("/meshes/0/weights", {1});
  refuses("/materials/0/alphaMode", "SOLID");
  refuses("/materials/0/normalTexture/texCoord", 99);
  refuses("/materials/0/pbrMetallicRoughness", {{"metallicFactor", "much"}});
  refuses("/images/0", json::object());
  refuses("/images/0/uri", "../picture.png");
  refuses("/textures/0/source", 1);
  refuses("/samplers/0/wrapS", 1);
}

TEST(SceneIo, RefusesAFileThatExpandsBeyondMeasure) {
  GltfBuilder builder = plain_square();  // 2,000 primitives draw the same 60,000 vertices
  const int position = builder.accessor(std::vector<float>(180000, 1.0f), "VEC3");
  json primitives = json::array();
  for (int i = 0; i < 2000; ++i)
    primitives.push_back({{"attributes", {{"POSITION", position}}}, {"mode", 0}});
  builder.root["meshes"][0]["primitives"] = primitives;
  EXPECT_NE(refusal(builder).find("more memory"), std::string::npos);
}

TEST(SceneIo, RefusesAFileWithMoreSparseElementsThanBytes) {
  GltfBuilder builder = plain_square();  // 1,000 accessors share one list of 60,000 replacements
  const int zeros = builder.accessor(std::vector<float>(180000, 0.0f), "VEC3");
  std::vector<std::uint16_t> places(60000);
  std::iota(places.begin(), places.end(), std::uint16_t(0));
  const int indices = builder.view(places);
  const json sparse = {{"count", 60000},
                       {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                       {"values", {{"bufferView", zeros}}}};
  for (int i = 0; i < 1000; ++i)
    builder.root["accessors"].push_back(
        {{"componentType", 5126}, {"count", 60000}, {"type", "VEC3"}, {"sparse", sparse}});
  builder.root["accessors"].back()["sparse"]["values"]["bufferView"] = 2;
  EXPECT_NE(refusal(builder).find("sparse elements"), std::string::npos);
}

TEST(SceneIo, ChecksIndicesOfMeshesThatAreNotShown) {
  GltfBuilder builder = square_with_indices({0, 1, 7}, 4);
  builder.root["nodes"][0].erase("mesh");
  EXPECT_NE(refusal(builder).find("element 2 is 7"), std::string::npos);
}

TEST(SceneIo, RefusesTheIndexAfterTheLastVertex) {
  EXPECT_NE(refusal(square_with_indices({0, 1, 4}, 4)).find("element 2 is 4"), std::string::npos);
}

TEST(SceneIo, RefusesACycleThatNoSceneShows) {
  GltfBuilder builder = plain_square();
  builder.root["nodes"].push_back({{"children", {2}}});
  builder.root["nodes"].push_back({{"children", {1}}});
  EXPECT_EQ(refusal(builder), "test.glb: nodes[1] is its own ancestor");
}

TEST(SceneIo, TakesBuffersWithoutBytesThatNothingReads) {
  GltfBuilder builder;
  builder.root["buffers"] = {{{"byteLength", 8}}};
  builder.root["bufferViews"] = {{{"buffer", 0}, {"byteLength", 8}}};
  EXPECT_EQ(refusal(builder), "");
}

TEST(SceneIo, NotesBytesAfterTheGlb) {
  std::vector<std::byte> bytes = plain_square().glb();
  bytes.push_back(std::byte(0));
  EXPECT_EQ(load_scene_from_memory(bytes, "long.glb").notes.size(), 1u);
}

TEST(SceneIo, ReadsPlainDataUris) {
  const std::string text =
      R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":3,"uri":"data:,%00%FFa"}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":3}],"accessors":[{"bufferView":0,"count":1,)"
      R"("componentType":5121,"type":"VEC3"}],"meshes":[{"primitives":[{"mode":0,"attributes":)"
      R"({"POSITION":0}}]}],"nodes":[{"mesh":0}]})";
  const Scene scene = load_scene_from_memory(std::as_bytes(std::span(text)), "plain.gltf");
  EXPECT_EQ(first_primitive(scene).positions, (std::vector{vec3(0, 255, 97)}));
}

TEST(SceneIo, RefusesWhatGoesOnAfterTheJson) {
  const std::string text = R"({"asset":{"version":"2.0"}} {})";
  EXPECT_THROW(load_scene_from_memory(std::as_bytes(std::span(text)), "two.gltf"), InputError);
}

std::string refusal_of_text(const std::string& text) {
  try {
    load_scene_from_memory(std::as_bytes(std::span(text)), "text.gltf");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SceneIo, RefusesAKeyThatStandsTwice) {
  EXPECT_EQ(refusal_of_text(R"({"asset":{"version":"2.0","version":"2.0"}})"),
            "text.gltf: JSON: key \"version\" stands twice in one object");
}

TEST(SceneIo, RefusesDeepNestingWhereverItIs) {
  const auto nested = [](std::size_t depth) {
    return R"({"asset":{"version":"2.0"},"extras":)" + std::string(depth, '[') +
           std::string(depth, ']') + "}";
  };
  EXPECT_EQ(refusal_of_text(nested(511)), "");  // and the root: 512
  EXPECT_EQ(refusal_of_text(nested(512)), "text.gltf: JSON: nested deeper than 512");
  EXPECT_EQ(refusal_of_text(nested(1000000)), "text.gltf: JSON: nested deeper than 512");
}

TEST(SceneIo, LoadsAnEmptyScene) {
  const Scene scene = load(GltfBuilder{});
  EXPECT_TRUE(scene.nodes.empty());
  EXPECT_TRUE(scene.notes.empty());
}

}  // namespace
}  // namespace parity
