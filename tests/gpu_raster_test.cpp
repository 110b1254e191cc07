// What the device's rasterisers owe each other and to mathematics; no reference on the CPU.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "gpu/raster/edge_coverage.h"
#include "tests/gpu_context.h"

namespace parity {
namespace {

Snapping device_snapping(const gpu::Context& context) {
  return context.info().is_swiftshader ? Snapping::swiftshader : Snapping::mesa;
}

/// A clip position that lands on (x, y) of the window.
vec4 at_window(const TriangleList& list, float x, float y, float depth, float w) {
  return vec4(2 * x / float(list.width) - 1, 2 * y / float(list.height) - 1, depth, 1) * w;
}

/// Triangles inside the window: any, slivers, and with corners on pixel centres and edges.
TriangleList random_triangles(int width, int height, int samples, int count, std::uint32_t seed) {
  TriangleList list{.width = width, .height = height, .samples = samples};
  std::mt19937 random(seed);
  const auto uniform = [&](float low, float high) {
    return low + (high - low) * float(random() >> 8) / float(1 << 24);
  };
  for (int t = 0; t < count; ++t) {
    const float reach = t % 3 == 0 ? 200.0f : (t % 3 == 1 ? 20.0f : 3.0f);
    const float step = t % 4 == 0 ? 2.0f : 0.0f;  // corners on halves of pixels
    const float x = uniform(0, float(width)), y = uniform(0, float(height));
    for (int corner = 0; corner < 3; ++corner) {
      float px = std::clamp(x + uniform(-reach, reach), 0.0f, float(width));
      float py =
          std::clamp(y + (t % 5 == 0 ? 0.05f : 1.0f) * uniform(-reach, reach), 0.0f, float(height));
      if (step > 0) px = std::round(px * step) / step, py = std::round(py * step) / step;
      list.clip_positions.push_back(at_window(list, px, py, uniform(0, 1), uniform(0.5f, 4)));
    }
    const auto first = std::uint32_t(3 * t);
    list.triangles.push_back({first, first + 1, first + 2});
  }
  return list;
}

std::size_t differences(const Coverage& a, const Coverage& b) {
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < a.count.size(); ++i)
    wrong += a.count[i] != b.count[i] || a.last[i] != b.last[i];
  return wrong;
}

TEST(GpuCoverage, OfComputeIsThatOfTheFixedFunctionBitForBit) {
  gpu::Context& context = test_context();
  if (!context.info().is_mesa_software && !context.info().is_swiftshader)
    GTEST_SKIP() << "skipped: the snapping of this device is not known";
  for (const int samples : {1, 4})
    for (const auto& [width, height] : {std::pair{512, 512}, {131, 77}}) {
      const TriangleList list = random_triangles(width, height, samples, 1500, 7);
      const Coverage hardware = gpu::hardware_coverage(context, list);
      const Coverage compute = gpu::edge_coverage(context, list, device_snapping(context));
      EXPECT_EQ(differences(hardware, compute), 0u) << width << " at " << samples;
    }
}

}  // namespace
}  // namespace parity
