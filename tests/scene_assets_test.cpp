#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "geometry/input_error.h"
#include "geometry/scene_io.h"
#include "tests/gltf_builder.h"
#include "tests/loading_cost.h"
#include "tests/shared_data.h"
#include "tests/temporary_folder.h"

namespace parity {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json read_json(const fs::path& file) {
  std::ifstream in(file);
  return json::parse(in);
}

std::size_t triangle_count(const Scene& scene) {
  std::size_t count = 0;
  for (const SceneMesh& mesh : scene.meshes)
    for (const Primitive& primitive : mesh.primitives)
      if (primitive.topology == Topology::triangles) count += primitive.indices.size() / 3;
  return count;
}

std::size_t left_out_count(const Scene& scene) {
  const std::string start = "triangles without area left out: ";
  for (const std::string& note : scene.notes)
    if (note.starts_with(start)) return std::stoul(note.substr(start.size()));
  return 0;
}

/// All that the contract of Scene promises of a primitive.
void expect_sound(const Scene& scene, const Primitive& p) {
  const std::size_t count = p.positions.size();
  for (const std::uint32_t index : p.indices) ASSERT_LT(index, count);
  const auto expect_unit = [](const vec3& v) { EXPECT_NEAR(glm::length(v), 1, 4 * 0x1p-24f); };
  if (p.topology == Topology::triangles) {
    ASSERT_EQ(p.normals.size(), count);
    for (const vec3& n : p.normals) expect_unit(n);
  }
  for (const vec4& t : p.tangents) {
    expect_unit(vec3(t));
    EXPECT_EQ(std::abs(t.w), 1);
  }
  ASSERT_TRUE(p.colors.empty() || p.colors.size() == count);
  for (const std::vector<vec2>& uvs : p.uvs) ASSERT_TRUE(uvs.empty() || uvs.size() == count);
  if (p.material < 0) return;
  const Material& m = scene.materials.at(std::size_t(p.material));
  for (const TextureUse& use : {m.base_color_texture, m.metallic_roughness_texture,
                                m.normal_texture, m.occlusion_texture, m.emission_texture}) {
    if (use.texture < 0) continue;
    ASSERT_LT(std::size_t(scene.textures.at(std::size_t(use.texture)).image), scene.images.size());
    ASSERT_EQ(p.uvs.at(std::size_t(use.uv_set)).size(), count);
  }
  // Bent normals, of the base or of the coat, and stretched highlights have a direction.
  const bool has_direction = m.normal_texture.texture >= 0 ||
                             m.clearcoat.normal_texture.texture >= 0 || m.anisotropy.strength > 0;
  EXPECT_EQ(p.tangents.size(), has_direction && p.topology == Topology::triangles ? count : 0u);
}

TEST(SceneAssets, AllLoadWithTheTrianglesThatTheListNames) {
  const auto list = shared_data("data/assets.json");
  if (!list) GTEST_SKIP() << "skipped: no shared data";
  int seen = 0;
  for (const json& asset : read_json(*list)) {
    const std::string file = asset["file"];
    if (!file.starts_with("gltf/")) continue;
    SCOPED_TRACE(file);
    const Scene scene = load_scene(list->parent_path() / file);
    EXPECT_EQ(triangle_count(scene) + left_out_count(scene), asset["tris"].get<std::size_t>());
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) ASSERT_LT(scene.nodes[i].parent, int(i));
    for (const SceneMesh& mesh : scene.meshes)
      for (const Primitive& primitive : mesh.primitives) expect_sound(scene, primitive);
    ++seen;
  }
  EXPECT_GT(seen, 50);
}

/// Middles of all triangles of the first primitive that has any.
std::vector<dvec3> middles(const Scene& scene) {
  std::vector<dvec3> list;
  const std::vector<dmat4> world = world_from_nodes(scene);
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
    if (scene.nodes[n].mesh < 0) continue;
    for (const Primitive& p : scene.meshes[std::size_t(scene.nodes[n].mesh)].primitives)
      for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3) {
        dvec3 sum{0.0};
        for (std::size_t c = 0; c < 3; ++c)
          sum += dvec3(world[n] * dvec4(dvec3(p.positions[p.indices[i + c]]), 1));
        list.push_back(sum / 3.0);
      }
  }
  return list;
}

/// The largest distance from a triangle's middle to the nearest of the other scene.
double farthest_middle(const Scene& from, const Scene& to) {
  const std::vector<dvec3> a = middles(from), b = middles(to);
  double farthest = 0;
  for (const dvec3& p : a) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const dvec3& q : b) nearest = std::min(nearest, glm::distance(p, q));
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

TEST(SceneAssets, QuantizedFoxIsTheFoxWithinTheStep) {
  const auto fox = shared_data("data/gltf/Fox/Fox.gltf");
  const auto quantized = shared_data("data/gltf/Fox_quantized.glb");
  if (!fox || !quantized) GTEST_SKIP() << "skipped: no shared data";
  const Scene exact = load_scene(*fox), rounded = load_scene(*quantized);
  const Bounds box = world_bounds(exact);
  const dvec3 size = box.max - box.min;
  // 14 bits over the longest side, half a step on each axis; as much again for 8-bit weights.
  const double step = std::max({size.x, size.y, size.z}) / 16383;
  EXPECT_LT(farthest_middle(exact, rounded), std::sqrt(3.0) * step);
  EXPECT_LT(farthest_middle(rounded, exact), std::sqrt(3.0) * step);
}

TEST(SceneAssets, DracoBoxIsTheBoxWithinTheStep) {
  const auto box = shared_data("data/gltf/Box.glb");
  const auto draco = shared_data("data/gltf/BoxDraco.glb");
  if (!box || !draco) GTEST_SKIP() << "skipped: no shared data";
  // At least 11 bits over a side of 1, half a step on each axis.
  EXPECT_LT(farthest_middle(load_scene(*box), load_scene(*draco)), std::sqrt(3.0) / 2 / 2047);
}

/// Corners of each triangle, the smallest first, the triangles in order.
std::vector<std::array<std::uint32_t, 3>> sorted_triangles(const Primitive& p) {
  std::vector<std::array<std::uint32_t, 3>> list;
  for (std::size_t i = 0; i < p.indices.size(); i += 3) {
    list.push_back({p.indices[i], p.indices[i + 1], p.indices[i + 2]});
    std::array<std::uint32_t, 3>& t = list.back();
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  }
  std::ranges::sort(list);
  return list;
}

// The codec turns triangles around, and the file's fallback holds its normals still encoded.
TEST(SceneAssets, MeshoptDecodesToItsOwnFallback) {
  const auto file = shared_data("data/gltf/MeshoptFallback/meshopt-fallback.gltf");
  if (!file) GTEST_SKIP() << "skipped: no shared data";
  const TemporaryFolder folder;
  for (const fs::directory_entry& entry : fs::directory_iterator(file->parent_path()))
    fs::copy_file(entry.path(), folder.path() / entry.path().filename());
  json plain = read_json(*file);
  for (json& view : plain["bufferViews"]) view.erase("extensions");
  plain["buffers"][1].erase("extensions");
  const Scene decoded = load_scene(*file);
  const Scene fallback = load_scene(folder.write("plain.gltf", plain.dump()));
  ASSERT_EQ(decoded.meshes.size(), 2u);
  for (std::size_t m = 0; m < decoded.meshes.size(); ++m) {
    const Primitive &a = decoded.meshes[m].primitives[0], &b = fallback.meshes[m].primitives[0];
    // Vertices are numbered alike, as both draw all of them.
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(sorted_triangles(a), sorted_triangles(b));
  }
  const Primitive& cube = decoded.meshes[0].primitives[0];
  for (std::size_t i = 0; i < cube.indices.size(); i += 3) {
    const auto corner = [&](std::size_t c) { return cube.positions[cube.indices[i + c]]; };
    const vec3 face = glm::normalize(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
    EXPECT_GT(glm::dot(cube.normals[cube.indices[i]], face), std::cos(1.0 / 127));  // 8-bit normals
  }
}

TEST(SceneAssets, FileTangentsAgreeWithOurs) {
  const auto file = shared_data("data/gltf/MaterialExtSphere/sphere.gltf");
  if (!file) GTEST_SKIP() << "skipped: no shared data";
  const TemporaryFolder folder;
  for (const fs::directory_entry& entry : fs::directory_iterator(file->parent_path()))
    fs::copy_file(entry.path(), folder.path() / entry.path().filename());
  json bare = read_json(*file);
  bare["meshes"][0]["primitives"][0]["attributes"].erase("TANGENT");
  const Scene given = load_scene(*file);
  const Scene made = load_scene(folder.write("bare.gltf", bare.dump()));
  const Primitive &a = given.meshes[0].primitives[0], &b = made.meshes[0].primitives[0];
  ASSERT_EQ(a.indices.size(), b.indices.size());
  for (std::size_t c = 0; c < a.indices.size(); ++c) {
    const vec4 t = a.tangents[a.indices[c]], u = b.tangents[b.indices[c]];
    EXPECT_EQ(t.w, u.w);
    EXPECT_GT(glm::dot(vec3(t), vec3(u)), std::cos(0.035));  // 2 degrees: another exporter's floats
  }
}

/// A .gltf beside its buffer.
std::string square_with_uri(const std::string& uri) {
  const json root = {
      {"asset", {{"version", "2.0"}}},
      {"buffers", {{{"byteLength", 36}, {"uri", uri}}}},
      {"bufferViews", {{{"buffer", 0}, {"byteLength", 36}}}},
      {"accessors", {{{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}}}},
      {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}}},
      {"nodes", {{{"mesh", 0}}}},
      {"scenes", {{{"nodes", {0}}}}}};
  return root.dump();
}

const std::vector<float> triangle{0, 0, 0, 1, 0, 0, 0, 1, 0};

TEST(SceneUris, ArePercentDecodedAndMayGoIntoFolders) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "in here");
  const auto bytes = std::as_bytes(std::span(triangle));
  folder.write("in here/a b.bin", bytes);
  for (const char* uri :
       {"in%20here/a%20b.bin", "in here/a b.bin", "in%20here/../in%20here/a b.bin"})
    EXPECT_EQ(triangle_count(load_scene(folder.write("scene.gltf", square_with_uri(uri)))), 1u)
        << uri;
}

TEST(SceneUris, StayInTheFolder) {
  const TemporaryFolder outside, folder;
  const auto bytes = std::as_bytes(std::span(triangle));
  const fs::path secret = outside.write("secret.bin", bytes);
  folder.write("near.bin", bytes);
  fs::create_symlink(secret, folder.path() / "link.bin");
  fs::create_directory_symlink(outside.path(), folder.path() / "door");
  fs::create_directory(folder.path() / "folder");
  ASSERT_EQ(::mkfifo((folder.path() / "pipe").c_str(), 0600), 0);
  const std::string out = "../" + outside.path().filename().string() + "/secret.bin";
  for (const std::string& uri :
       {out, "%2e%2e/" + out.substr(3), secret.string(), "file://" + secret.string(),
        std::string("link.bin"), std::string("door/secret.bin"), std::string("folder"),
        std::string("pipe"), std::string("near.bin%00.png"), std::string("\\near.bin"),
        std::string("near.bin/"), std::string("/dev/zero")})
    EXPECT_THROW(load_scene(folder.write("scene.gltf", square_with_uri(uri))), InputError) << uri;
}

TEST(SceneUris, AreOfRegularFilesOnly) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder.path() / "pipe.glb").c_str(), 0600), 0);
  fs::create_directory(folder.path() / "folder.glb");
  for (const char* name : {"pipe.glb", "folder.glb"}) try {
      load_scene(folder.path() / name);
      ADD_FAILURE() << name;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("regular file"), std::string::npos) << error.what();
    }
}

TEST(SceneUris, OpenNothingFromMemory) {
  const std::string text = square_with_uri("near.bin");
  EXPECT_THROW(load_scene_from_memory(std::as_bytes(std::span(text)), "memory"), InputError);
}

TEST(SceneAssets, AMillionTrianglesLoadInTwoSecondsAndFourTimesTheirSize) {
  const TemporaryFolder folder;
  const fs::path file = folder.write("million.glb", waved_square(708));
  const LoadingCost cost = cost_of_loading(file);
  EXPECT_EQ(cost.triangles, 1002528u);
#ifndef __SANITIZE_ADDRESS__
  EXPECT_LT(cost.seconds, 2);
  EXPECT_LT(cost.bytes, 4 * fs::file_size(file));
#endif
  std::printf("[          ] %.2f s, %.2f times the file\n", cost.seconds,
              double(cost.bytes) / double(fs::file_size(file)));
}

}  // namespace
}  // namespace parity
