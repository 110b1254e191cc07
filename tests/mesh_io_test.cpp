#include "geometry/mesh_io.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <filesystem>
#include <fstream>

#include "geometry/color.h"
#include "geometry/input_error.h"
#include "geometry/output_error.h"
#include "tests/shared_data.h"

namespace parity {
namespace {

Mesh decode(const std::string& text, const std::string& name) {
  return decode_mesh(std::as_bytes(std::span(text.data(), text.size())), name);
}

void expect_refused(const std::string& text, const std::string& name, const std::string& place) {
  try {
    decode(text, name);
    ADD_FAILURE() << "accepted: " << text;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(name + place), std::string::npos) << error.what();
  }
}

/// The bytes of numbers, one after the other, lowest first or highest first.
template <typename T>
std::string bytes_of(std::initializer_list<T> values, bool big_endian = false) {
  std::string bytes;
  for (T value : values) {
    std::string own(reinterpret_cast<const char*>(&value), sizeof value);
    if (big_endian) std::reverse(own.begin(), own.end());
    bytes += own;
  }
  return bytes;
}

using Corners = std::vector<std::uint32_t>;

const std::vector<vec3> corner_of_a_cube = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const std::string four_vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";

TEST(Obj, ReadsEveryFormOfCorner) {
  const Mesh mesh =
      decode(four_vertices +
                 "vt 0.25 0.5\nvt 1 0\nvn 0 0 2\nvn 3 0 0\n"
                 "f 1 2 3\nf 1/1 2/2 3/1\nf 1//1 2//2 3//1\nf -4/-2/-1 -3/-1/-2 -2/1/1\n"
                 "f 1// 2// 3// 4//\n",
             "a.obj");
  EXPECT_EQ(mesh.positions, corner_of_a_cube);
  EXPECT_EQ(mesh.corners, (Corners{0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 3}));
  EXPECT_EQ(mesh.face_begin, (Corners{0, 3, 6, 9, 12, 16}));
  ASSERT_EQ(mesh.corner_uvs.size(), mesh.corners.size());
  ASSERT_EQ(mesh.corner_normals.size(), mesh.corners.size());
  EXPECT_EQ(mesh.corner_uvs[0], vec2(0));
  EXPECT_EQ(mesh.corner_uvs[4], vec2(1, 0));
  EXPECT_EQ(mesh.corner_uvs[9], vec2(0.25f, 0.5f));
  EXPECT_EQ(mesh.corner_normals[6], vec3(0, 0, 1));
  EXPECT_EQ(mesh.corner_normals[9], vec3(1, 0, 0));
  EXPECT_EQ(mesh.corner_normals[0], vec3(0));
}

TEST(Obj, ReadsColoursWeightsContinuedLinesAndComments) {
  const Mesh mesh = decode(
      "# c\r\nv 0 0 0 1 0.5 0\r\nv 1 0 0 0 0 1 \nv +1e0 1 .5 1.0\n\tf 1 \\\n 2 3 # end\n"
      "f 3 2 1",
      "a.obj");
  EXPECT_EQ(mesh.positions[2], vec3(1, 1, 0.5f));
  EXPECT_EQ(mesh.face_count(), 2u);
  EXPECT_EQ(mesh.vertex_colors, (std::vector<vec3>{{1, 0.5f, 0}, {0, 0, 1}, {1, 1, 1}}));
  EXPECT_TRUE(mesh.notes.empty());
}

TEST(Obj, AFaceMayNameVerticesThatFollow) {
  EXPECT_EQ(decode("f 1 2 3\n" + four_vertices, "a.obj").corners, (Corners{0, 1, 2}));
}

TEST(Obj, RefusesWithFileAndLine) {
  expect_refused(four_vertices + "f 0 1 2\n", "a.obj", ":5");
  expect_refused(four_vertices + "f 1 2 5\n", "a.obj", ":5");
  expect_refused(four_vertices + "f 1 2 -5\n", "a.obj", ":5");
  expect_refused(four_vertices + "f 1 2 4294967297\n", "a.obj", ":5");
  expect_refused(four_vertices + "f 1 2 99999999999999999999\n", "a.obj", ":5");
  expect_refused(four_vertices + "f 1 2 3x\n", "a.obj", ":5");
  expect_refused(four_vertices + "f 1/1 2/1 3/1\n", "a.obj", ":5");
  expect_refused(four_vertices + "f /1 2 3\n", "a.obj", ":5");
  expect_refused("v 0 0 nan\nf 1 1 1\n", "a.obj", ":1");
  expect_refused("v 0 0 1e39\nf 1 1 1\n", "a.obj", ":1");
  expect_refused("v 0 0\nf 1 1 1\n", "a.obj", ":1");
  expect_refused("", "a.obj", ": has no faces");
  expect_refused(four_vertices, "a.obj", ": has no faces");
  expect_refused(four_vertices, "a.txt", ": is not known as a mesh");
}

TEST(Obj, LeavesOutShortFacesWithANote) {
  const Mesh mesh = decode(four_vertices + "f 1 2\nf 1/ 2/ 3/\nl 1 2\n", "a.obj");
  EXPECT_EQ(mesh.face_count(), 1u);
  EXPECT_EQ(mesh.corners, (Corners{0, 1, 2}));
  EXPECT_EQ(mesh.notes.size(), 2u);  // the face, the line
}

TEST(Obj, TakesMaterialsFromItsFolderOnly) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("parity_mesh_io_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder / "asset");
  std::ofstream(folder / "outside.mtl") << "newmtl a\nKd 9 9 9\n";
  std::ofstream(folder / "asset" / "in side.mtl")
      << "newmtl other\nKd 5 5 5\nnewmtl a b\nKd 0.25 0.5 1\nKe 1 2 3\nTr 0.25\nPr 0.5\n"
         "map_Kd -s 1 1 1 wood.png\n";
  std::ofstream(folder / "asset" / "m.obj")
      << "mtllib ../outside.mtl\nmtllib in side.mtl\nmtllib gone.mtl\n"
      << four_vertices << "f 1 2 3\nusemtl a b\nf 1 2 4\nusemtl a\nf 1 3 4\n";
  const Mesh mesh = load_mesh(folder / "asset" / "m.obj");
  std::filesystem::remove_all(folder);
  EXPECT_EQ(mesh.face_materials, (std::vector<int>{-1, 0, 1}));
  ASSERT_EQ(mesh.materials.size(), 2u);
  EXPECT_EQ(mesh.materials[0].name, "a b");
  EXPECT_EQ(mesh.materials[0].diffuse, vec3(0.25f, 0.5f, 1));
  EXPECT_EQ(mesh.materials[0].emission, vec3(1, 2, 3));
  EXPECT_EQ(mesh.materials[0].opacity, 0.75f);
  EXPECT_EQ(mesh.materials[0].roughness, 0.5f);
  EXPECT_EQ(mesh.materials[0].diffuse_map, "wood.png");
  EXPECT_EQ(mesh.materials[1].diffuse, vec3(0.8f));
  EXPECT_EQ(mesh.notes.size(), 2u);
}

TEST(Ply, ReadsTextAndBothByteOrders) {
  const std::string properties =
      "comment c\nelement vertex 3\nproperty double x\nproperty float32 y\nproperty short z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty list uchar int "
      "extra\n"
      "element junk 2\nproperty int8 j\nelement face 1\nproperty float quality\n"
      "property list ushort uint vertex_indices\nend_header\n";
  std::string text =
      "ply\nformat ascii 1.0\n" + properties +
      "0 0 0 255 0 128 0\n1 0 -2 0 0 0 2 7 8\n0 0.5\n1 9 9 9 1 7\n-1 -2\n2.5 3 0 1 2\n";
  const Mesh want = decode(text, "a.ply");
  EXPECT_EQ(want.positions, (std::vector<vec3>{{0, 0, 0}, {1, 0, -2}, {0, 0.5f, 1}}));
  EXPECT_EQ(want.corners, (Corners{0, 1, 2}));
  EXPECT_EQ(want.vertex_colors[0], vec3(1, 0, linear_from_srgb(128.0f / 255.0f)));
  for (bool big : {false, true}) {
    std::string bytes = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                        "_endian 1.0\n" + properties;
    const auto vertex = [&](double x, float y, std::int16_t z, std::string color,
                            std::string extra) {
      bytes += bytes_of({x}, big) + bytes_of({y}, big) + bytes_of({z}, big) + color + extra;
    };
    vertex(0, 0, 0, "\xff" + std::string(1, '\0') + "\x80", std::string(1, '\0'));
    vertex(1, 0, -2, std::string(3, '\0'), "\2" + bytes_of({7, 8}, big));
    vertex(0, 0.5f, 1, "\x9\x9\x9", "\1" + bytes_of({7}, big));
    bytes += "\xff\xfe" + bytes_of({2.5f}, big) + bytes_of({std::uint16_t(3)}, big) +
             bytes_of({0u, 1u, 2u}, big);
    const Mesh got = decode(bytes, "a.ply");
    EXPECT_EQ(got.positions, want.positions);
    EXPECT_EQ(got.corners, want.corners);
    EXPECT_EQ(got.vertex_colors, want.vertex_colors);
    for (std::size_t length = 0; length < bytes.size(); ++length)
      EXPECT_THROW(decode(bytes.substr(0, length), "a.ply"), InputError) << length;
  }
}

TEST(Ply, BelievesNoCount) {
  const std::string vertices =
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string three = "0 0 0\n1 0 0\n0 1 0\n";
  const auto ply = [&](const std::string& face, const std::string& body) {
    return "ply\nformat ascii 1.0\n" + vertices + face + "end_header\n" + body;
  };
  const std::string list = "property list uchar int vertex_indices\n";
  expect_refused(ply("element face 1000000000\n" + list, three + "3 0 1 2\n"), "a.ply", "");
  expect_refused(ply("element face 9223372036854775807\n" + list, three), "a.ply", "");
  expect_refused(ply("element face -1\n" + list, three), "a.ply", "");
  expect_refused(ply("element face 1\n" + list, three + "3 0 1 3\n"), "a.ply", "");
  expect_refused(ply("element face 1\n" + list, three + "3 0 1 -1\n"), "a.ply", "");
  expect_refused(ply("element face 1\n" + list, three + "-3 0 1 2\n"), "a.ply", "");
  expect_refused(ply("element face 1\n" + list, three + "255 0 1 2\n"), "a.ply", "");
  expect_refused(ply("element face 1\nproperty list float int vertex_indices\n", three), "a.ply",
                 "");
  expect_refused(ply("element face 1\nproperty int vertex_indices\n", three + "1\n"), "a.ply", "");
  expect_refused(ply("", three), "a.ply", ": has no faces");
  expect_refused(ply("element nothing 9223372036854775807\n", three), "a.ply", ": has no faces");
  EXPECT_EQ(decode(ply("element face 1\n" + list, three + "3 0 1 2"), "a.ply").face_count(), 1u);
}

std::string binary_stl(const std::vector<std::vector<float>>& facets, std::uint32_t count) {
  std::string bytes = "solid but binary" + std::string(64, ' ') + bytes_of({count});
  for (const auto& facet : facets) {
    bytes += std::string(12, '\0');
    for (float value : facet) bytes += bytes_of({value});
    bytes += std::string(2, '\0');
  }
  return bytes;
}

TEST(Stl, WeldsEqualCornersOnly) {
  const float tiny = std::bit_cast<float>(1u);
  const Mesh mesh = decode(binary_stl({{0, 0, 0, 1, 0, 0, 0, 1, 0},
                                       {-0.0f, 0, 0, 0, 1, 0, 0, 0, 1},
                                       {tiny, 0, 0, 1, 0, 0, 0, 0, 1}},
                                      3),
                           "a.stl");
  EXPECT_EQ(mesh.corners, (Corners{0, 1, 2, 0, 2, 3, 4, 1, 3}));
  EXPECT_EQ(mesh.vertex_count(), 5u);
}

TEST(Stl, ReadsTextOfSeveralSolids) {
  const std::string solid =
      "solid a b\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n"
      "   vertex 0 1E0 0\n  endloop\n endfacet\nendsolid a b\n";
  EXPECT_EQ(decode(solid + solid, "a.stl").corners, (Corners{0, 1, 2, 0, 1, 2}));
  expect_refused(solid.substr(0, solid.find("  endloop")), "a.stl", ":");
  expect_refused("solid\n vertex 0 0 0\n vertex 1 0 0\nendloop\n", "a.stl", ":4");
  expect_refused("solid\n", "a.stl", ": has no facets");
}

TEST(Stl, LeavesOutFacetsThatAreNotFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Mesh mesh =
      decode(binary_stl({{0, 0, nan, 1, 0, 0, 0, 1, 0}, {0, 0, 0, 1, 0, 0, 0, 1, 0}}, 2), "a.stl");
  EXPECT_EQ(mesh.face_count(), 1u);
  EXPECT_EQ(mesh.vertex_count(), 3u);
  EXPECT_EQ(mesh.notes.size(), 1u);
}

TEST(Stl, BelievesNoCount) {
  std::string bytes = binary_stl({{0, 0, 0, 1, 0, 0, 0, 1, 0}}, 0xffffffffu);
  bytes.replace(0, 5, "binar");
  expect_refused(bytes, "a.stl", ": byte 80");
  expect_refused("short", "a.stl", "");
  expect_refused(binary_stl({}, 0), "a.stl", ": has no facets");
}

TEST(Off, ReadsColoursNormalsAndComments) {
  const Mesh mesh = decode(
      "CNOFF # comment\n3 1 3\n\n0 0 0 0 0 2 255 0 0 255\n1 0 0 0 0 1 0 128 0 255\n"
      "# more\n0 1 0 0 1 0 0 0 255 255\n3 2 0 1 0.5 0.5 0.5\n",
      "a.off");
  EXPECT_EQ(mesh.corners, (Corners{2, 0, 1}));
  EXPECT_EQ(mesh.vertex_colors[0], vec3(1, 0, 0));
  EXPECT_EQ(mesh.vertex_colors[1], vec3(0, linear_from_srgb(128.0f / 255.0f), 0));
  EXPECT_EQ(mesh.corner_normals, (std::vector<vec3>{{0, 1, 0}, {0, 0, 1}, {0, 0, 1}}));
  EXPECT_EQ(decode("OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2", "a.off").corners, (Corners{0, 1, 2}));
}

TEST(Off, LeavesOutShortFacesWithANote) {
  const Mesh mesh = decode("OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n3 0 1 2\n", "a.off");
  EXPECT_EQ(mesh.face_begin, (Corners{0, 3}));
  EXPECT_EQ(mesh.corners, (Corners{0, 1, 2}));
  EXPECT_EQ(mesh.notes.size(), 1u);
}

TEST(Off, Refuses) {
  const std::string three = "0 0 0\n1 0 0\n0 1 0\n";
  expect_refused("OFF\n3 1 0\n" + three + "3 0 1 3\n", "a.off", ":6");
  expect_refused("OFF\n3 1 0\n" + three + "3 0 1 -1\n", "a.off", ":6");
  expect_refused("OFF\n3 1 0\n" + three + "4 0 1 2\n", "a.off", ":6");
  expect_refused("OFF\n3 1000000000 0\n" + three, "a.off", ":2");
  expect_refused("OFF\n3 2 0\n" + three + "3 0 1 2\n", "a.off", ":6");
  expect_refused("OFF\n3 0 0\n" + three, "a.off", ":2");
  expect_refused("OOF\n", "a.off", ":1");
  expect_refused("", "a.off", ":0");
}

TEST(MeshIo, WhatIsSavedComesBack) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("parity_mesh_io_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0.1f, 1e-30f, -3e38f}, {1.0f / 3.0f, 2, 0}, {-1, 2, 0}};
  mesh.corners = {0, 1, 2, 3, 2, 1, 0};
  mesh.face_begin = {0, 4, 7};
  for (const char* ending : {".obj", ".ply", ".off"}) {
    save_mesh(folder / ("m" + std::string(ending)), mesh);
    const Mesh back = load_mesh(folder / ("m" + std::string(ending)));
    EXPECT_EQ(back.positions, mesh.positions) << ending;
    EXPECT_EQ(back.corners, mesh.corners) << ending;
    EXPECT_EQ(back.face_begin, mesh.face_begin) << ending;
  }
  save_mesh(folder / "m.stl", mesh);
  EXPECT_EQ(load_mesh(folder / "m.stl").face_count(), 3u);
  EXPECT_THROW(save_mesh(folder / "m.xyz", mesh), std::invalid_argument);
  EXPECT_THROW(save_mesh(folder / "none" / "m.ply", mesh), OutputError);
  std::filesystem::remove_all(folder);
}

TEST(MeshIo, ObjKeepsAttributesOfCorners) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("parity_mesh_io_" + std::to_string(::getpid()) + ".obj");
  Mesh mesh;
  mesh.positions = corner_of_a_cube;
  mesh.vertex_colors = {{0, 0, 0}, {0.1f, 0.2f, 0.3f}, {1, 1, 1}, {0, 1, 0}};
  mesh.corners = {0, 1, 2, 0, 2, 3};
  mesh.face_begin = {0, 3, 6};
  mesh.corner_uvs = {{0, 0}, {1, 0}, {0, 1}, {0.3f, 0.7f}, {1, 1}, {2, -1}};
  mesh.corner_normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  save_mesh(file, mesh);
  const Mesh back = load_mesh(file);
  std::filesystem::remove(file);
  EXPECT_EQ(back.vertex_colors, mesh.vertex_colors);
  EXPECT_EQ(back.corner_uvs, mesh.corner_uvs);
  EXPECT_EQ(back.corner_normals, mesh.corner_normals);
}

}  // namespace
}  // namespace parity
