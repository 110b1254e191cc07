#include <gtest/gtest.h>

#include <numeric>

#include "geometry/grid.h"
#include "gpu/core/commands.h"
#include "shaders.h"
#include "shaders/core/layout.h"
#include "tests/gpu_context.h"

namespace parity {
namespace {

using gpu::Buffer;
using gpu::Commands;
using gpu::Kernel;

std::vector<float> counting(std::size_t count) {
  std::vector<float> values(count);
  std::iota(values.begin(), values.end(), 0.0f);
  return values;
}

std::vector<float> add_on_device(gpu::Context& context, const std::vector<float>& values,
                                 float addend) {
  const Kernel<TestAddArgs> kernel(context, gpu::shaders::core_test_add_comp);
  const Buffer<float> in(context, values);
  const Buffer<float> out(context, values.size());
  const auto count = static_cast<std::uint32_t>(values.size());
  context.run([&](Commands& commands) {
    commands.dispatch(kernel, {.x = count},
                      {.values = in, .results = out, .count = count, .addend = addend});
  });
  return out.read();
}

TEST(GpuCore, RunsAKernelOnAnySize) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{131}}) {
    std::vector<float> expected = counting(count);
    for (float& value : expected) value += 2;
    EXPECT_EQ(add_on_device(test_context(), counting(count), 2), expected) << count;
  }
}

struct Triangle {
  std::vector<vec4> positions;
  vec4 color;
};

/// A picture of one triangle over black.
std::vector<vec4> draw(gpu::Context& context, const Triangle& triangle, gpu::Culling culling,
                       bool mirrored) {
  const gpu::Image image(context, {.width = 8, .height = 8, .format = gpu::Format::rgba32_float});
  const gpu::RasterPipeline<TestTriangleArgs> pipeline(
      context, gpu::shaders::core_test_triangle_vert, gpu::shaders::core_test_triangle_frag,
      {.colors = {gpu::Format::rgba32_float}, .blends = {}, .depth = {}, .specializations = {}});
  const Buffer<vec4> positions(context, triangle.positions);
  const Buffer<vec4> colors(context, std::vector<vec4>(3, triangle.color));
  const Buffer<vec4> texels(context, 64);
  context.run([&](Commands& commands) {
    commands.render({.colors = {{.image = &image, .clear = {{0, 0, 0, 0}}}}, .depth = {}},
                    [&](gpu::RenderPass& pass) {
                      pass.set_culling(culling, mirrored);
                      pass.draw(pipeline, {.positions = positions, .colors = colors}, 3);
                    });
    commands.copy(image, texels);
  });
  return texels.read();
}

//  Upper left half of the picture, counter-clockwise as one sees it: down the left side first.
const Triangle counter_clockwise{{{-1, -1, 0, 1}, {-1, 1, 0, 1}, {1, -1, 0, 1}}, {1, 2, 3, 4}};

TEST(GpuCore, DrawsATriangleWithRowZeroOnTop) {
  const std::vector<vec4> texels =
      draw(test_context(), counter_clockwise, gpu::Culling::none, false);
  EXPECT_EQ(texels[0], vec4(1, 2, 3, 4));
  EXPECT_EQ(texels[63], vec4(0));
}

TEST(GpuCore, CounterClockwiseTrianglesAreFront) {
  EXPECT_EQ(draw(test_context(), counter_clockwise, gpu::Culling::back, false)[0],
            vec4(1, 2, 3, 4));
  EXPECT_EQ(draw(test_context(), counter_clockwise, gpu::Culling::front, false)[0], vec4(0));
  EXPECT_EQ(draw(test_context(), counter_clockwise, gpu::Culling::back, true)[0], vec4(0));
}

}  // namespace
}  // namespace parity
