#include "geometry/frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "geometry/jitter.h"

namespace parity {
namespace {

dvec3 project(const dmat4& clip, const dvec3& p) {
  const dvec4 c = clip * dvec4(p, 1.0);
  return dvec3(c) / c.w;
}

Scene one_triangle() {
  Scene scene;
  Primitive primitive;
  primitive.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  primitive.normals.assign(3, {0, 0, 1});
  primitive.indices = {0, 1, 2};
  scene.meshes.push_back({"triangle", {primitive}});
  Node node;
  node.mesh = 0;
  scene.nodes.push_back(node);
  return scene;
}

TEST(ClipFromView, PutsTheUpperEdgeOfTheViewAtMinusOne) {
  Camera camera;
  camera.vertical_fov = std::numbers::pi / 2;  // tan of half is 1
  camera.near = 1;
  camera.far = 10;
  const dmat4 clip = clip_from_view(camera, 2.0, DepthMode::standard);
  EXPECT_NEAR(project(clip, {0, 5, -5}).y, -1, 1e-15);
  EXPECT_NEAR(project(clip, {10, 0, -5}).x, 1, 1e-15);
}

TEST(ClipFromView, MapsNearAndFarToTheEndsOfEachDepthMode) {
  for (const bool orthographic : {false, true}) {
    Camera camera;
    camera.orthographic = orthographic;
    camera.near = 0.5;
    camera.far = 200;
    const dmat4 standard = clip_from_view(camera, 1, DepthMode::standard);
    const dmat4 reverse = clip_from_view(camera, 1, DepthMode::reverse_z);
    EXPECT_NEAR(project(standard, {0, 0, -0.5}).z, 0, 1e-13);
    EXPECT_NEAR(project(standard, {0, 0, -200}).z, 1, 1e-13);
    EXPECT_NEAR(project(reverse, {0, 0, -0.5}).z, 1, 1e-13);
    EXPECT_NEAR(project(reverse, {0, 0, -200}).z, 0, 1e-13);
  }
}

TEST(ClipFromView, InfiniteFarReachesTheEndOnlyAtInfinity) {
  Camera camera;
  camera.near = 0.25;
  const dmat4 reverse = clip_from_view(camera, 1, DepthMode::reverse_z);
  EXPECT_NEAR(project(reverse, {0, 0, -1000}).z, 0.25 / 1000, 1e-18);
}

TEST(ClipFromView, NeverStretchesACameraWithItsOwnAspect) {
  Camera camera;
  camera.aspect = 2.0;
  for (const double aspect : {0.5, 1.0, 2.0, 3.0}) {
    const dmat4 clip = clip_from_view(camera, aspect, DepthMode::standard);
    EXPECT_NEAR(-clip[1][1] / clip[0][0], aspect, 1e-14);  // square pixels
    EXPECT_GE(1 / clip[0][0], 2 * std::tan(camera.vertical_fov / 2) * (1 - 1e-15));
    EXPECT_GE(-1 / clip[1][1], std::tan(camera.vertical_fov / 2) * (1 - 1e-15));
  }
}

TEST(ClipFromView, RefusesWhatIsNoCamera) {
  Camera camera;
  camera.near = 0;
  EXPECT_THROW(clip_from_view(camera, 1, DepthMode::standard), std::invalid_argument);
  camera.near = 1;
  camera.far = 1;
  EXPECT_THROW(clip_from_view(camera, 1, DepthMode::standard), std::invalid_argument);
  camera.far.reset();
  camera.vertical_fov = 0;
  EXPECT_THROW(clip_from_view(camera, 1, DepthMode::standard), std::invalid_argument);
}

TEST(MakeFrame, FramesASceneWithoutACamera) {
  const Scene scene = one_triangle();
  for (const ivec2 size : {ivec2(100, 100), ivec2(300, 50), ivec2(40, 200)}) {
    const Frame frame = make_frame(scene, {.width = size.x, .height = size.y});
    ASSERT_EQ(frame.draws.size(), 1u);
    for (const vec3& p : scene.meshes[0].primitives[0].positions) {
      const vec4 clip = frame.draws[0].clip_from_object * vec4(p, 1);
      EXPECT_GT(clip.w, 0);
      EXPECT_LT(std::abs(clip.x), clip.w);
      EXPECT_LT(std::abs(clip.y), clip.w);
      EXPECT_GT(clip.z, 0);
      EXPECT_LT(clip.z, clip.w);
    }
  }
}

TEST(MakeFrame, TurnsNormalsByTheInverseTranspose) {
  Scene scene = one_triangle();
  scene.nodes[0].parent_from_node = dmat4(1.0);
  scene.nodes[0].parent_from_node[0][0] = -2;  // mirrored and stretched
  const Frame frame = make_frame(scene, {});
  EXPECT_TRUE(frame.draws[0].mirrored);
  const dvec3 tangent{1, -1, 0};
  const dvec3 normal{1, 1, 0};  // perpendicular in object space
  const dvec3 world_tangent = dmat3(frame.draws[0].world_from_object) * tangent;
  const dvec3 world_normal = frame.draws[0].world_from_object_normal * normal;
  EXPECT_NEAR(glm::dot(world_tangent, world_normal), 0, 1e-12);
  EXPECT_LT(world_normal.x, 0);  // (1, 1, 0) mirrored in x still points out of the same side
}

// Seen from the front of what is single-sided, mirrored or not; else from the usual side.
TEST(MakeFrame, FramesTheFrontOfATriangle) {
  Scene scene = one_triangle();
  for (const double mirror : {1.0, -1.0})
    for (const bool double_sided : {false, true}) {
      scene.materials = {{.double_sided = double_sided}};
      scene.meshes[0].primitives[0].material = 0;
      scene.nodes[0].parent_from_node = dmat4(1.0);
      scene.nodes[0].parent_from_node[2] *= mirror;
      const Frame frame = make_frame(scene, {});
      EXPECT_EQ(frame.eye.z > 0, mirror > 0 || double_sided);
      EXPECT_GT(frame.eye.x, 0);
    }
}

TEST(ViewDirection, IsWhereThePlaceIsSeen) {
  Scene scene;
  scene.cameras.emplace_back();
  Node node;
  node.camera = 0;
  node.parent_from_node = glm::translate(dmat4(1.0), dvec3(1, 2, 3)) *
                          glm::rotate(dmat4(1.0), 0.7, glm::normalize(dvec3(1, -2, 0.5)));
  scene.nodes.push_back(node);
  const Frame frame = shifted(make_frame(scene, {.width = 64, .height = 48}), {0.3, -0.4});
  for (const dvec2 place : {dvec2(0, 0), dvec2(64, 48), dvec2(20.5, 3.5), dvec2(50, 40)}) {
    const dvec3 direction = view_direction(frame, place);
    EXPECT_NEAR(glm::length(direction), 1, 1e-15);
    const dvec4 clip =
        frame.clip_from_view * frame.view_from_world * dvec4(frame.eye + 5.0 * direction, 1);
    EXPECT_GT(clip.w, 0);
    EXPECT_NEAR((clip.x / clip.w + 1) * 32, place.x, 1e-12);
    EXPECT_NEAR((clip.y / clip.w + 1) * 24, place.y, 1e-12);
  }
}

TEST(MakeFrame, RefusesLogarithmicDepthWithoutAPerspectiveOrAFarPlane) {
  Scene scene = one_triangle();
  scene.cameras = {{.name = "flat", .orthographic = true, .far = 9.0}, {.name = "endless"}};
  scene.nodes.resize(3);
  scene.nodes[1].camera = 0;
  scene.nodes[2].camera = 1;
  for (const auto& camera : {"flat", "endless"}) {
    EXPECT_THROW(make_frame(scene, {.camera = camera, .depth = DepthMode::logarithmic}),
                 std::invalid_argument);
    EXPECT_NO_THROW(make_frame(scene, {.camera = camera}));
  }
}

TEST(MakeFrame, NamesTheCamerasThereAre) {
  Scene scene = one_triangle();
  scene.cameras.push_back({.name = "front"});
  try {
    make_frame(scene, {.camera = "back"});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("front"), std::string::npos);
  }
}

}  // namespace
}  // namespace parity
