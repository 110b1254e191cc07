#include "geometry/texture_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "geometry/jitter.h"
#include "geometry/mip_pyramid.h"
#include "geometry/random.h"
#include "geometry/scene_io.h"
#include "gpu/sampling/antialias.h"
#include "gpu/texture/mip_pyramid.h"
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

/// A corner of a triangle that is as often fat as a splinter, edge-on, or through the eye.
std::array<dvec3, 3> random_corners(Random& random) {
  const auto vector = [&](double length) {
    return length * dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  };
  const dvec3 middle{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-6, 4.5)};
  const dvec3 way = vector(std::exp2(random.uniform(-6, 2)));
  dvec3 across = vector(std::exp2(random.uniform(-10, 1)));
  const int kind = int(random.uniform(0, 4));
  if (kind == 0) across = 0.01 * across + double(random.uniform(-1, 1)) * way;
  if (kind == 1)
    across = (middle - dvec3(0, 0, 5)) * double(random.uniform(-1, 1)) + 0.002 * across;
  return {middle, middle + way, middle + across};
}

std::array<vec2, 3> random_uvs(Random& random) {
  const auto place = [&] { return vec2(random.uniform(-2, 2), random.uniform(-2, 2)); };
  const vec2 way = place() * float(std::exp2(random.uniform(-6, 2)));
  vec2 across = place() * float(std::exp2(random.uniform(-6, 2)));
  const int kind = int(random.uniform(0, 6));
  if (kind == 0) across = way * float(random.uniform(-1, 1));  // along a line
  const vec2 first = place();
  if (kind == 1) return {first, first, first};
  return {first, first + way, first + across};
}

/// Unlit triangles, each with a texture of its own.
Scene odd_triangles(Random& random, int count, const Sampler& sampler) {
  Scene scene = texture_test::textured_square(64, 0, sampler);
  const Material material = scene.materials[0];
  const Primitive square = scene.meshes[0].primitives[0];
  scene.meshes[0].primitives.clear();
  for (int i = 0; i < count; ++i) {
    scene.images.push_back(scene.images[0]);
    scene.textures.push_back({int(scene.images.size()) - 1, sampler});
    scene.materials.push_back(material);
    scene.materials.back().double_sided = i % 2 == 0;
    scene.materials.back().base_color_texture.texture = int(scene.textures.size()) - 1;
    Primitive& p = scene.meshes[0].primitives.emplace_back();
    p.material = int(scene.materials.size()) - 1;
    for (const dvec3& corner : random_corners(random)) p.positions.push_back(vec3(corner));
    p.normals.assign(3, vec3(0, 0, 1));
    const std::array<vec2, 3> uvs = random_uvs(random);
    p.uvs = {{uvs.begin(), uvs.end()}};
    p.indices = {0, 1, 2};
    if (i % 16 == 0) p.topology = Topology::lines;
    if (i % 16 == 0) p.indices = {0, 1};
  }
  return scene;
}

TEST_F(GpuRenderer, LevelsOfOddTrianglesAreNotMissed) {
  Random random{11};
  int left_out = 0;
  for (const Sampler& sampler : {Sampler{.mip = Filter::linear, .max_anisotropy = 1},
                                 Sampler{.mip = Filter::nearest}, Sampler{.max_anisotropy = 8}})
    // 1 and 4 are drawn by the pipeline, 8 by kernels, where a device has no more.
    for (const int samples : {1, 4, 8}) {
      const Scene scene = odd_triangles(random, 120, sampler);
      const Frame frame = make_frame(scene, {.width = 40, .height = 33, .samples = samples});
      gpu::Renderer all(test_context(), scene);
      const std::vector<LevelRange> levels = read_levels(scene, frame);
      EXPECT_EQ(shown(scene, frame, levels), all.render(frame).color) << samples;
      gpu::Renderer moved(test_context(), scene, {}, read_levels(scene, frame, true));
      for (const dvec2 shift : {dvec2(0.4, -0.3), dvec2(-1, 0.9)})
        EXPECT_EQ(moved.render(shifted(frame, shift)).color,
                  all.render(shifted(frame, shift)).color)
            << samples;
      left_out +=
          int(std::ranges::count_if(levels, [](const LevelRange& r) { return r.least > 0; }));
    }
  EXPECT_GT(left_out, 9 * 30) << "of 9 times 120";
}

TEST_F(GpuRenderer, AntialiasedPicturesReadNoOtherLevels) {
  Random random{13};
  const Scene scene = odd_triangles(random, 120, {.max_anisotropy = 8});
  const Frame frame = make_frame(scene, {.width = 40, .height = 33});
  const std::vector<dvec2> shifts{{-0.4, 0.1}, {0.3, -0.45}, {0.1, 0.4}};
  gpu::Antialiaser all(test_context(), scene);
  gpu::Antialiaser moved(test_context(), scene, read_levels(scene, frame, true));
  EXPECT_EQ(moved.accumulate(frame, shifts).color, all.accumulate(frame, shifts).color);
  EXPECT_EQ(moved.adaptive(frame, 0.04f, 1).color, all.adaptive(frame, 0.04f, 1).color);
  std::vector<LevelRange> levels(scene.images.size());
  for (const dvec2& shift : shifts) join(levels, read_levels(scene, shifted(frame, shift)));
  gpu::Antialiaser these(test_context(), scene, levels);
  EXPECT_EQ(these.accumulate(frame, shifts).color, all.accumulate(frame, shifts).color);
}

TEST_F(GpuRenderer, LevelsMadeInBandsAreThoseOfTheWhole) {
  gpu::Context& context = test_context();
  const gpu::MipPyramid pyramid(context);
  Random random{17};
  for (const ivec2 size : {ivec2(512, 520), ivec2(1048, 264), ivec2(24, 8), ivec2(30, 40)}) {
    Grid<u8vec4> image(size.x, size.y);
    for (u8vec4& t : image)
      t = u8vec4(random.uniform(0, 255), random.uniform(0, 255), random.uniform(0, 255), 255);
    const std::vector<MipLevel> levels = mip_levels(size.x, size.y);
    for (const bool srgb : {false, true}) {
      const std::vector<std::uint32_t> all =
          gpu::build_pyramid(context, pyramid, image, srgb, {}).read();
      for (const std::size_t first : {1, 2, 3})
        for (const std::size_t last : {first, levels.size() - 1}) {
          const std::vector<std::uint32_t> some =
              gpu::build_pyramid(context, pyramid, image, srgb,
                                 {.head = 3, .first = first, .last = last})
                  .read();
          const MipLevel& end = levels[last];
          const std::size_t count =
              end.first + std::size_t(end.width) * std::size_t(end.height) - levels[first].first;
          ASSERT_EQ(some.size(), 3 + count);
          EXPECT_TRUE(std::equal(some.begin() + 3, some.end(),
                                 all.begin() + std::ptrdiff_t(levels[first].first)))
              << size.x << " x " << size.y << ", " << first << " to " << last;
        }
    }
  }
}

TEST(MipPyramid, ALevelThatIsNotKeptIsNeverOnTheDeviceAsAWhole) {
  gpu::Context context;
  const gpu::MipPyramid pyramid(context);
  const Grid<u8vec4> image(2048, 2048, u8vec4(7));
  const std::uint64_t before = context.memory_bytes();
  gpu::build_pyramid(context, pyramid, image, true, {.first = 3});
  EXPECT_LT(context.peak_memory_bytes() - before, 4 * image.size());
}

TEST(ReadLevels, LeaveOutTheFullSizeOfThinTrianglesAndThoseBetweenSamples) {
  // 7.76 texels a pixel, whatever the triangles: two along the diagonal are 0.02 px wide.
  Scene scene = texture_test::textured_square(256, 0, Sampler{});
  Primitive& p = scene.meshes[0].primitives[0];
  p.positions[1] = vec3(0.0008f, -0.0008f, 0.0f);
  p.uvs[0][1] = vec2(0.5004f, 0.5004f);
  EXPECT_EQ(levels_of(scene).least, 2);
  scene.materials[0].double_sided = false;
  EXPECT_EQ(levels_of(scene).least, 2);
  scene.nodes[1].parent_from_node[0] = dvec4(-1, 0, 0, 0);
  scene.nodes[1].parent_from_node[2] = dvec4(0, 0, -1, 0);
  p = texture_test::textured_square(256, 0, Sampler{}).meshes[0].primitives[0];
  EXPECT_TRUE(levels_of(scene).empty()) << "turned away";
  scene.nodes[1].parent_from_node = dmat4(1.0);
  // Within 0.2 px beside a middle, with uvs of one place: only where the frame moves.
  p.positions = {{0.01f, 0.01f, 0.0f}, {0.012f, 0.01f, 0.0f}, {0.01f, 0.012f, 0.0f}};
  p.uvs[0].assign(3, vec2(0.5f));
  p.normals.resize(3);
  p.indices = {0, 1, 2};
  const Frame frame = make_frame(scene, {.width = 33, .height = 33});
  EXPECT_TRUE(read_levels(scene, frame)[0].empty());
  EXPECT_EQ(read_levels(scene, frame, true)[0].least, 0);
}

TEST(ReadLevels, OfRealScenesAreFew) {
  const auto bytes = [](const Grid<u8vec4>& image, const LevelRange& range) {
    double sum = 0;
    for (int i = std::max(range.least, 0); i <= range.greatest; ++i)
      sum += double(std::max(image.width() >> i, 1)) * std::max(image.height() >> i, 1);
    return sum;
  };
  int scenes = 0;
  for (const char* name : {"Fox/Fox.gltf", "FlightHelmet/FlightHelmet.gltf"}) {
    const auto file = shared_data(std::string("data/gltf/") + name);
    if (!file) continue;
    ++scenes;
    Scene scene = load_scene(*file);
    for (Texture& t : scene.textures) t.sampler.max_anisotropy = default_max_anisotropy;
    const Frame frame = make_frame(scene, {.width = 48, .height = 32, .samples = 4});
    const std::vector<LevelRange> levels = read_levels(scene, frame);
    double read = 0, all = 0;
    for (std::size_t i = 0; i < levels.size(); ++i) {
      read += bytes(scene.images[i], levels[i]);
      all += bytes(scene.images[i], {0, 14});
    }
    EXPECT_LT(read, 0.3 * all) << name;
  }
  if (scenes == 0) GTEST_SKIP() << "no shared data";
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
        "Fox/Fox.gltf", "TextureTransformTest/TextureTransformTest.gltf"})
    if (const auto file = shared_data(std::string("data/gltf/") + name)) files.push_back(*file);
  for (const std::filesystem::path& file : files) {
    Scene scene = load_scene(file);
    for (Texture& t : scene.textures) t.sampler.max_anisotropy = default_max_anisotropy;
    for (const int samples : {1, 4, 8}) {
      const int width = samples == 4 ? 100 : 40;
      const Frame frame =
          make_frame(scene, {.width = width, .height = width / 2, .samples = samples});
      EXPECT_EQ(shown(scene, frame, read_levels(scene, frame)), shown(scene, frame, {})) << file;
    }
  }
}

}  // namespace
}  // namespace parity
