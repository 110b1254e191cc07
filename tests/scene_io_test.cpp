#include <gtest/gtest.h>

#include <cmath>

#include "tests/scene_loading.h"

namespace parity {
namespace {

using nlohmann::json;

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

TEST(SceneIo, StepsOverInterleavedValues) {
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

TEST(SceneIo, LoadsAnEmptyScene) {
  const Scene scene = load(GltfBuilder{});
  EXPECT_TRUE(scene.nodes.empty());
  EXPECT_TRUE(scene.notes.empty());
}

}  // namespace
}  // namespace parity
