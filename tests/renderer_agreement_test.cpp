#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/environment.h"
#include "geometry/input_error.h"
#include "geometry/opaque_frame.h"
#include "geometry/scene_io.h"
#include "gpu/raster/renderer.h"
#include "gpu/shading/prefilter.h"
#include "tests/gpu_context.h"
#include "tests/raster/agreement.h"
#include "tests/shared_data.h"

namespace parity {
namespace {

namespace fs = std::filesystem;

/// Every scene of the shared data; none without them.
std::vector<std::string> scene_files() {
  std::vector<std::string> files;
  const auto folder = shared_data("data/gltf");
  if (!folder) return files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(*folder))
    if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb")
      files.push_back(fs::relative(entry.path(), *folder).string());
  std::sort(files.begin(), files.end());
  return files;
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;  // with folder and ending: Box.glb is not Box/Box.gltf
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); },
      '_');
  return name;
}

class RenderersAgree : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (!gpu::can_render(test_context().info()))
      GTEST_SKIP() << "skipped: the device cannot render";
  }
};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(RenderersAgree);

TEST_P(RenderersAgree, OnEveryJudgedPixel) {
  Scene scene = load_scene(*shared_data("data/gltf/" + GetParam()));
  for (Texture& texture : scene.textures) texture.sampler.max_anisotropy = default_max_anisotropy;
  for (const int samples : {1, 4}) {
    Frame frame = make_frame(scene, {.width = 149, .height = 101, .samples = samples});
    frame.behind = look_behind(scene, frame, [&](const Frame& opaque) {
      return gpu::render(test_context(), scene, opaque).color;
    });
    const raster_test::Agreement agreement =
        raster_test::draw_and_compare(test_context(), scene, frame);
    EXPECT_EQ(agreement.wrong(), 0u) << samples << " samples: " << agreement.text();
    RecordProperty("samples_" + std::to_string(samples), agreement.text());
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, RenderersAgree, testing::ValuesIn(scene_files()), test_name);

/// Bands of colour and a lamp.
Grid<vec4> lamp_and_sky() {
  Grid<vec4> picture{64, 32};
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x)
      picture(x, y) = vec4(0.2f + 0.02f * float(32 - y), 0.3f, 0.1f + 0.01f * float(x), 1);
  for (int y = 6; y < 10; ++y)
    for (int x = 20; x < 26; ++x) picture(x, y) = vec4(20, 18, 15, 1);
  return picture;
}

/// Light of degree 2 at most, with a part of each polynomial in some channel.
Grid<vec4> soft_sky() {
  Grid<vec4> picture{64, 32};
  for (int row = 0; row < 32; ++row)
    for (int column = 0; column < 64; ++column) {
      const float theta = 3.1415927f * (float(row) + 0.5f) / 32;
      const float phi = 3.1415927f * ((float(column) + 0.5f) / 32 - 1);
      const float x = std::sin(theta) * std::sin(phi), y = std::cos(theta);
      const float z = -std::sin(theta) * std::cos(phi);
      picture(column, row) =
          vec4(1 + 0.5f * y + 0.3f * x * y + 0.2f * (3 * z * z - 1), 1 + 0.5f * z + 0.4f * y * z,
               1 + 0.5f * x + 0.3f * x * z + 0.3f * (x * x - y * y), 1);
    }
  return picture;
}

TEST(RendererAgreement, HoldsUnderAnEnvironment) {
  const Scene scene = load_scene(fs::path(PARITY_SOURCE_DIR) / "assets/sphere_grid.glb");
  Frame frame = make_frame(scene, {.width = 149, .height = 101, .key_light = false});
  for (const bool has_lamp : {true, false}) {
    const Grid<vec4> picture = has_lamp ? lamp_and_sky() : soft_sky();
    frame.environment = gpu::prefilter(test_context(), environment_map(picture, 64), 16);
    EXPECT_NE(frame.environment->irradiance.empty(), has_lamp);  // else harmonics light it
    const raster_test::Agreement agreement =
        raster_test::draw_and_compare(test_context(), scene, frame);
    EXPECT_EQ(agreement.wrong(), 0u) << agreement.text();
  }
}

TEST(RendererAgreement, AWhiteFurnaceShowsNoWhiteMetal) {
  Scene scene = load_scene(fs::path(PARITY_SOURCE_DIR) / "assets/sphere_grid.glb");
  for (Material& m : scene.materials) {
    m.base_color = vec4(1);
    m.metallic = 1;
  }
  const Frame frame =
      make_frame(scene, {.width = 149, .height = 101, .environment = vec3(1), .key_light = false});
  const Picture device = gpu::render(test_context(), scene, frame);
  const Picture host = cpu::render(scene, frame).picture;
  for (const Picture* picture : {&device, &host})
    for (const vec4& c : picture->color)
      EXPECT_TRUE(c.w == 0 || glm::length(vec3(c) - vec3(1)) < 0.01f) << c.x;
}

TEST(RendererAgreement, FailsForAShiftedPicture) {
  const Scene scene = load_scene(fs::path(PARITY_SOURCE_DIR) / "assets/demo.glb");
  const Frame frame = make_frame(scene, {.width = 97, .height = 61});
  const cpu::Rendered want = cpu::render(scene, frame, {.elements = true, .bounds = true});
  Picture got = want.picture;
  EXPECT_EQ(raster_test::compare(got, want).wrong(), 0u);
  std::rotate(got.color.begin(), got.color.begin() + 1, got.color.end());
  EXPECT_GT(raster_test::compare(got, want).color, 100u);
  got = want.picture;
  std::rotate(got.element.begin(), got.element.begin() + 1, got.element.end());
  EXPECT_GT(raster_test::compare(got, want).depth, 10u);
}

}  // namespace
}  // namespace parity
