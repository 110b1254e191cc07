#include "geometry/texture_levels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "geometry/random.h"
#include "geometry/scene_io.h"
#include "tests/renderer_scene.h"
#include "tests/shared_data.h"
#include "tests/texture/textured_square.h"

/// Texture levels that no pixel reads are left out.
namespace parity {
namespace {

LevelRange levels_of(const Scene& scene) {
  return read_levels(scene, make_frame(scene, {.width = 33, .height = 33}))[0];
}

TEST(ReadLevels, AreThoseOfTheFootprint) {
  // At z = 0 the picture of 33 px shows 2 m: 256 texels are 7.76 a pixel, 2.96 levels up.
  const LevelRange some = levels_of(texture_test::textured_square(256, 0, Sampler{}));
  EXPECT_EQ(some.least, 2);
  EXPECT_GE(some.greatest, 3);
  EXPECT_LE(some.greatest, 4);
  const LevelRange magnified = levels_of(texture_test::textured_square(8, 0, Sampler{}));
  EXPECT_EQ(magnified.least, 0);
  EXPECT_EQ(magnified.greatest, 0);
  const Sampler following{.max_anisotropy = 8};
  EXPECT_EQ(levels_of(texture_test::textured_square(8, 0, following)).greatest, 0);
  // Ten times as far it is a tenth as large: 6.28 levels up.
  const LevelRange far = levels_of(texture_test::textured_square(256, -45, Sampler{}));
  EXPECT_EQ(far.least, 6);
  const Sampler no_mips{.mip = std::nullopt};
  EXPECT_EQ(levels_of(texture_test::textured_square(256, 0, no_mips)).greatest, 0);
}

TEST(ReadLevels, AreNoneOfWhatIsNotSeenAndAllOfWhatReachesTheEye) {
  Scene scene = texture_test::textured_square(64, 0, Sampler{});
  scene.nodes[1].parent_from_node[3] = dvec4(20, 0, 0, 1);
  EXPECT_TRUE(levels_of(scene).empty());
  scene.nodes[1].parent_from_node = dmat4(1.0);
  scene.meshes[0].primitives[0].positions[0].z = 9;  // behind the eye
  EXPECT_EQ(levels_of(scene).least, 0);
  EXPECT_EQ(levels_of(scene).greatest, 6);
  scene = texture_test::textured_square(64, -45, Sampler{});
  scene.materials[0].alpha_mode = AlphaMode::mask;
  EXPECT_EQ(levels_of(scene).least, 0) << "shadow maps see it from elsewhere";
}

Grid<vec4> shown(const Scene& scene, const Frame& frame, std::vector<LevelRange> levels) {
  return gpu::Renderer(test_context(), scene, {}, std::move(levels)).render(frame).color;
}

TEST_F(GpuRenderer, LevelsThatNoPixelReadsAreNotMissed) {
  const std::array<Sampler, 4> samplers{{{.mip = Filter::nearest},
                                         {.mip = Filter::linear},
                                         {.max_anisotropy = 2},
                                         {.max_anisotropy = 16}}};
  Random random{7};
  for (const Sampler& sampler : samplers)
    for (const double depth : {2.0, 0.0, -20.0})
      for (int turn = 0; turn < 4; ++turn) {
        Scene scene = texture_test::textured_square(128, depth, sampler);
        const double angle = turn * 0.5;  // up to nearly edge-on
        const dvec3 axis = glm::normalize(dvec3(random.uniform(-1, 1), 1, 0));
        dmat4 place = glm::mat4_cast(dquat(std::cos(angle / 2), std::sin(angle / 2) * axis.x,
                                           std::sin(angle / 2) * axis.y, 0));
        place[3] = place * dvec4(0, 0, -depth, 1) + dvec4(0, 0, depth, 0);
        scene.nodes[1].parent_from_node = place;
        const int samples = turn % 2 == 0 ? 1 : 4;
        const Frame frame = make_frame(scene, {.width = 33, .height = 33, .samples = samples});
        const std::vector<LevelRange> levels = read_levels(scene, frame);
        EXPECT_EQ(shown(scene, frame, levels), shown(scene, frame, {}))
            << sampler.max_anisotropy << ", " << depth << ", " << angle;
      }
}

TEST_F(GpuRenderer, ALevelTooFewIsSeen) {
  const Scene scene =
      texture_test::textured_square(256, 0, {.mip = Filter::linear, .max_anisotropy = 1});
  const Frame frame = make_frame(scene, {.width = 33, .height = 33});
  const Grid<vec4> all = shown(scene, frame, {});
  EXPECT_NE(shown(scene, frame, {{3, 8}}), all);
  EXPECT_NE(shown(scene, frame, {{0, 2}}), all);
  EXPECT_THROW(shown(scene, frame, {{0, 8}, {0, 8}}), std::invalid_argument);
}

TEST_F(GpuRenderer, ScenesLookAlikeWithTheLevelsThatTheyRead) {
  std::vector<std::filesystem::path> files;
  for (const char* name : {"assets/demo.glb", "assets/sphere_grid.glb"})
    files.push_back(std::filesystem::path(PARITY_SOURCE_DIR) / name);
  for (const char* name :
       {"TextureSettingsTest/TextureSettingsTest.gltf", "FlightHelmet/FlightHelmet.gltf",
        "TextureTransformTest/TextureTransformTest.gltf"})
    if (const auto file = shared_data(std::string("data/gltf/") + name)) files.push_back(*file);
  for (const std::filesystem::path& file : files) {
    Scene scene = load_scene(file);
    for (Texture& t : scene.textures) t.sampler.max_anisotropy = default_max_anisotropy;
    for (const int width : {40, 150}) {
      const Frame frame = make_frame(scene, {.width = width, .height = width / 2, .samples = 4});
      EXPECT_EQ(shown(scene, frame, read_levels(scene, frame)), shown(scene, frame, {})) << file;
    }
  }
}

}  // namespace
}  // namespace parity
