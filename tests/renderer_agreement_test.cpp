#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/input_error.h"
#include "geometry/scene_io.h"
#include "gpu/raster/renderer.h"
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
  const Scene scene = load_scene(*shared_data("data/gltf/" + GetParam()));
  for (const int samples : {1, 4}) {
    const Frame frame = make_frame(scene, {.width = 149, .height = 101, .samples = samples});
    const raster_test::Agreement agreement =
        raster_test::draw_and_compare(test_context(), scene, frame);
    EXPECT_EQ(agreement.wrong(), 0u) << samples << " samples: " << agreement.text();
    RecordProperty("samples_" + std::to_string(samples), agreement.text());
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, RenderersAgree, testing::ValuesIn(scene_files()), test_name);

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
