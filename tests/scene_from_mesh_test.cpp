#include "geometry/scene_from_mesh.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/image_io.h"
#include "geometry/scene_io.h"
#include "tests/temporary_folder.h"

namespace parity {
namespace {

//  3---2
//  |   |    one face of four corners
//  0---1
Mesh square() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.corners = {0, 1, 2, 3};
  mesh.face_begin = {0, 4};
  return mesh;
}

Primitive only_primitive(const Mesh& mesh) {
  const Scene scene = scene_from_mesh(mesh, "folder/square.ply", std::nullopt);
  return scene.meshes.at(0).primitives.at(0);
}

TEST(SceneFromMesh, CutsFacesIntoTriangles) {
  const Scene scene = scene_from_mesh(square(), "folder/square.ply", std::nullopt);
  ASSERT_EQ(scene.nodes.size(), 1u);
  EXPECT_EQ(scene.nodes[0].mesh, 0);
  EXPECT_EQ(scene.nodes[0].name, "square");
  const Primitive& primitive = scene.meshes.at(0).primitives.at(0);
  EXPECT_EQ(primitive.positions.size(), 4u);
  EXPECT_EQ(primitive.indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(scene.materials.at(std::size_t(primitive.material)).metallic, 0);
}

/// Two squares that share an edge, the second turned up by an angle.
Mesh fold(float radians) {
  Mesh mesh = square();
  const float c = std::cos(radians), s = std::sin(radians);
  mesh.positions.insert(mesh.positions.end(), {{1 + c, 0, s}, {1 + c, 1, s}});
  mesh.corners.insert(mesh.corners.end(), {1, 4, 5, 2});
  mesh.face_begin.push_back(8);
  return mesh;
}

TEST(SceneFromMesh, SmoothsOverAFlatFoldAndKeepsASharpOne) {
  EXPECT_EQ(only_primitive(fold(0.9f)).positions.size(), 6u);
  const Primitive sharp = only_primitive(fold(1.2f));  // 60 degrees are 1.047
  EXPECT_EQ(sharp.positions.size(), 8u);
  EXPECT_EQ(sharp.normals[1], vec3(0, 0, 1));
  // Equal areas: the normal of the smooth fold halves the angle, (-sin a/2, 0, cos a/2), where one
  // triangle of each face meets; at vertex 2 the first face counts twice.
  const Primitive smooth = only_primitive(fold(0.5f));
  const dvec3 expected = glm::normalize(dvec3(-2 * std::sin(0.5), 0, 1 + 2 * std::cos(0.5)));
  EXPECT_NEAR(glm::length(dvec3(smooth.normals[1]) - expected), 0, 1e-6);
}

TEST(SceneFromMesh, TakesNormalsAndTurnsTextureCoordinatesDown) {
  Mesh mesh = square();
  mesh.corner_normals.assign(4, vec3(0, 0.6f, 0.8f));
  mesh.corner_uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 0.75f}};
  const Primitive primitive = only_primitive(mesh);
  EXPECT_NEAR(glm::length(primitive.normals[0] - vec3(0, 0.6f, 0.8f)), 0, 0x1p-23f);
  EXPECT_EQ(primitive.uvs.at(0), (std::vector<vec2>{{0, 1}, {1, 1}, {1, 0}, {0, 0.25f}}));
}

TEST(SceneFromMesh, MakesAPrimitiveForEachMaterial) {
  Mesh mesh = fold(1.2f);
  mesh.materials.resize(1);
  mesh.materials[0].diffuse = {1, 0, 0};
  mesh.materials[0].shininess = 30;
  mesh.materials[0].opacity = 0.5f;
  mesh.face_materials = {-1, 0};
  const Scene scene = scene_from_mesh(mesh, "fold.obj", std::nullopt);
  ASSERT_EQ(scene.meshes.at(0).primitives.size(), 2u);
  const Primitive& red = scene.meshes[0].primitives[1];
  EXPECT_EQ(red.material, 0);
  const Material& material = scene.materials.at(0);
  EXPECT_EQ(material.base_color, vec4(1, 0, 0, 0.5f));
  EXPECT_EQ(material.alpha_mode, AlphaMode::blend);
  EXPECT_FLOAT_EQ(material.roughness, 0.5f);  // alpha = sqrt(2 / 32) = 1/4, its root is 1/2
}

TEST(SceneFromMesh, LoadsThePictureThatTheMaterialNames) {
  const TemporaryFolder folder;
  save_png(folder.path() / "map.png", Grid<u8vec4>(3, 2, u8vec4(1, 2, 3, 255)));
  folder.write("a.mtl", std::string("newmtl m\nKd 1 1 1\nmap_Kd map.png\n"
                                    "newmtl n\nKd 1 1 1\nmap_Kd ../map.png\n"));
  const std::string text =
      "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
      "usemtl m\nf 1/1 2/2 3/3\nusemtl n\nf 1/1 3/3 2/2\n";
  const Scene scene = load_scene(folder.write("a.obj", text));
  ASSERT_EQ(scene.images.size(), 1u);
  EXPECT_EQ(scene.images[0].width(), 3);
  EXPECT_EQ(scene.materials.at(0).base_color_texture.texture, 0);
  EXPECT_EQ(scene.materials.at(1).base_color_texture.texture, -1);
  EXPECT_EQ(scene.notes.size(), 1u);
}

TEST(SceneFromMesh, LeavesOutFacesWithoutArea) {
  Mesh mesh = square();
  mesh.corners.insert(mesh.corners.end(), {0, 1, 0});
  mesh.face_begin.push_back(7);
  const Scene scene = scene_from_mesh(mesh, "square.ply", std::nullopt);
  EXPECT_EQ(scene.meshes.at(0).primitives.at(0).indices.size(), 6u);
  EXPECT_EQ(scene.notes.size(), 1u);
}

}  // namespace
}  // namespace parity
