// The same picture, bit for bit: of this run and another one, whatever the number of threads.
#include <gtest/gtest.h>
#include <omp.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "cpu_reference/raster/renderer.h"
#include "geometry/scene_io.h"
#include "gpu/raster/renderer.h"
#include "tests/gpu_context.h"
#include "tests/shared_data.h"

namespace parity {
namespace {

/// The demo and, where they are at hand, scenes with all lights and all filters.
std::vector<Scene> scenes() {
  std::vector<Scene> scenes{
      load_scene(std::filesystem::path(PARITY_SOURCE_DIR) / "assets/demo.glb")};
  for (const char* name :
       {"PunctualLights/sphere_lights.gltf", "TextureSettingsTest/TextureSettingsTest.gltf"})
    if (const auto file = shared_data(std::string("data/gltf/") + name))
      scenes.push_back(load_scene(*file));
  return scenes;
}

Frame frame_of(const Scene& scene, int samples) {
  return make_frame(scene, {.width = 37, .height = 97, .samples = samples});
}

/// FNV-1a of all that a picture holds.
std::uint64_t hash_of(const Picture& picture) {
  std::uint64_t hash = 14695981039346656037u;
  const auto add = [&](const auto& grid) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(grid.values().data());
    for (std::size_t i = 0; i < grid.size() * sizeof(grid.values()[0]); ++i)
      hash = (hash ^ bytes[i]) * 1099511628211u;
  };
  add(picture.color);
  add(picture.depth);
  add(picture.element);
  return hash;
}

constexpr std::array<int, 4> all_samples{1, 2, 4, 8};

/// What a child of this program prints: a line a picture, each drawn twice.
TEST(PictureHashes, DISABLED_AreTheseOnThisDevice) {
  gpu::Context context;
  for (const Scene& scene : scenes())
    for (const int samples : all_samples) {
      const Frame frame = frame_of(scene, samples);
      const std::uint64_t hash = hash_of(gpu::render(context, scene, frame, {.elements = true}));
      EXPECT_EQ(hash_of(gpu::render(context, scene, frame, {.elements = true})), hash);
      std::printf("picture %d %016lx\n", samples, static_cast<unsigned long>(hash));
    }
}

/// The lines of a child with so many threads of the device.
std::string hashes_with(const std::string& device_threads) {
  const std::string command = "LP_NUM_THREADS=" + device_threads + " /proc/" +
                              std::to_string(::getpid()) +
                              "/exe --gtest_also_run_disabled_tests "
                              "--gtest_filter=PictureHashes.DISABLED_AreTheseOnThisDevice";
  std::string lines;
  FILE* pipe = ::popen(command.c_str(), "r");
  std::array<char, 4096> line;
  while (std::fgets(line.data(), int(line.size()), pipe))
    if (std::string(line.data()).starts_with("picture ")) lines += line.data();
  EXPECT_EQ(::pclose(pipe), 0) << device_threads << " threads";
  return lines;
}

TEST(DevicePictures, AreBitEqualAcrossRunsAndThreads) {
  if (!gpu::can_render(test_context().info())) GTEST_SKIP() << "skipped: the device cannot render";
  const std::string want = hashes_with("4");
  EXPECT_FALSE(want.empty());
  for (const char* threads : {"0", "1", "2"})
    EXPECT_EQ(hashes_with(threads), want) << threads << " threads";
}

TEST(ReferencePictures, AreBitEqualAcrossRunsAndThreads) {
  const int threads_before = omp_get_max_threads();
  for (const Scene& scene : scenes())
    for (const int samples : {1, 8}) {
      const Frame frame = frame_of(scene, samples);
      omp_set_num_threads(1);
      const std::uint64_t want = hash_of(cpu::render(scene, frame, {.elements = true}).picture);
      for (const int threads : {2, 3}) {
        omp_set_num_threads(threads);
        EXPECT_EQ(hash_of(cpu::render(scene, frame, {.elements = true}).picture), want)
            << samples << " samples, " << threads << " threads";
      }
    }
  omp_set_num_threads(threads_before);
}

}  // namespace
}  // namespace parity
