#include <gtest/gtest.h>

#include <numeric>

#include "tests/scene_loading.h"

namespace parity {
namespace {

using nlohmann::json;

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

TEST(SceneIo, RefusesOffsetsThatWrapTo32Bits) {
  const double wraps_to_0 = 4294967296;
  GltfBuilder sparse = plain_square();
  const int indices = sparse.view(std::vector<std::uint8_t>{1});
  sparse.root["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", indices}, {"componentType", 5121}, {"byteOffset", wraps_to_0}}},
      {"values", {{"bufferView", 0}}}};
  EXPECT_NE(refusal(sparse).find("indices.byteOffset is 4294967296"), std::string::npos);
  GltfBuilder compressed = plain_square();
  compressed.root["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {
      {"buffer", 0}, {"byteOffset", wraps_to_0}, {"byteLength", 48}, {"byteStride", 12},
      {"count", 4},  {"mode", "ATTRIBUTES"}};
  EXPECT_NE(refusal(compressed).find("byteOffset is 4294967296"), std::string::npos);
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

}  // namespace
}  // namespace parity
