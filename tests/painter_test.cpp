// The painter's algorithm on the device.
#include "cpu_reference/raster/painter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "gpu/raster/depth.h"
#include "gpu/raster/painter.h"
#include "tests/gpu_context.h"
#include "tests/raster/triangles.h"

namespace parity {
namespace {

TEST(GpuPainter, SortsLikeAStableSort) {
  std::mt19937 random(9);
  std::vector<float> keys{0.0f, -0.0f, 1.0f, -1.0f, std::numeric_limits<float>::infinity()};
  for (int i = 0; i < 20000; ++i) keys.push_back(float(int(random() % 2001) - 1000) / 7);
  std::vector<std::uint32_t> want(keys.size());
  std::iota(want.begin(), want.end(), 0u);
  std::stable_sort(want.begin(), want.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return keys[a] > keys[b]; });
  EXPECT_EQ(gpu::painter_order(test_context(), keys), want);
  EXPECT_TRUE(gpu::painter_order(test_context(), {}).empty());
  keys[3] = std::nanf("");
  EXPECT_THROW(gpu::painter_order(test_context(), keys), std::invalid_argument);
}

TEST(GpuPainter, SeesWhatADepthTestSeesOfStackedTriangles) {
  TriangleList list = raster_test::make_triangles(raster_test::Kind::random, 64, 1, 40, 6);
  for (std::size_t i = 0; i < list.clip_positions.size(); ++i) {
    vec4& p = list.clip_positions[i];
    p = p * ((1 + float((i / 3) * 7 % 40)) / p.w);  // 40 different distances
    p.z = p.w - 0.5f;                               // nearer is less
  }
  const DepthImage painted = gpu::painter(test_context(), list);
  EXPECT_EQ(painted.front,
            gpu::depth_test(test_context(), list, DepthMode::standard, 0, 0, Snapping::mesa).front);
}

// The device sorts by the mean w, the reference by the depth of centroids: with z = w - n the same
// order, as z / w = 1 - n / w rises with w.
TEST(GpuPainter, PaintsTiltedTrianglesInTheOrderOfTheReference) {
  TriangleList list = raster_test::make_triangles(raster_test::Kind::random, 96, 1, 60, 9);
  for (vec4& p : list.clip_positions) p.z = p.w - 0.25f;
  const Snapping snapping = raster_test::for_device(list, test_context().info()).snapping;
  if (snapping != Snapping::mesa) GTEST_SKIP() << "skipped: the painter snaps as Mesa does";
  EXPECT_EQ(gpu::painter(test_context(), list).front, cpu::painter(list, snapping).front);
}

}  // namespace
}  // namespace parity
