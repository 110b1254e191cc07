#include <gtest/gtest.h>

#include <algorithm>

#include "gpu/core/commands.h"
#include "shaders.h"
#include "shaders/core/layout.h"
#include "tests/gpu_context.h"

namespace parity {
namespace {

using gpu::Buffer;
using gpu::Commands;
using gpu::Format;
using gpu::Image;
using gpu::Kernel;
using Pipeline = gpu::RasterPipeline<TestTriangleArgs>;

struct Triangle {
  std::vector<vec4> positions;
  vec4 color{1, 1, 1, 1};
};

//  Upper left half of the picture, counter-clockwise as one sees it: down the left side first.
const Triangle upper_left{{{-1, -1, 0.25f, 1}, {-1, 1, 0.25f, 1}, {1, -1, 0.25f, 1}}, {1, 2, 3, 4}};

//  All that lies left of x = 4.5 in a picture of 8 pixels.
const Triangle left_of_middle{{{0.125f, -3, 0.25f, 1}, {-7, 0, 0.25f, 1}, {0.125f, 3, 0.25f, 1}}};

struct Geometry {
  Geometry(gpu::Context& context, const Triangle& triangle)
      : positions(context, triangle.positions),
        colors(context, std::vector<vec4>(4, triangle.color)) {}
  TestTriangleArgs args() const { return {.positions = positions, .colors = colors}; }
  Buffer<vec4> positions;
  Buffer<vec4> colors;
};

Pipeline make_pipeline(gpu::Context& context, const gpu::RasterOptions& options) {
  return {context, gpu::shaders::core_test_triangle_vert, gpu::shaders::core_test_triangle_frag,
          options};
}

gpu::RasterOptions color_only(Format format) {
  gpu::RasterOptions options;
  options.colors = {format};
  return options;
}

/// An 8 x 8 picture of the triangle over black.
std::vector<vec4> draw(gpu::Context& context, const Triangle& triangle, gpu::Culling culling,
                       bool mirrored) {
  const Image image(context, {.width = 8, .height = 8, .format = Format::rgba32_float});
  const Pipeline pipeline = make_pipeline(context, color_only(Format::rgba32_float));
  const Geometry geometry(context, triangle);
  const Buffer<vec4> texels(context, 64);
  context.run([&](Commands& commands) {
    commands.render({.colors = {{.image = &image, .clear = {{0, 0, 0, 0}}}}, .depth = {}},
                    [&](gpu::RenderPass& pass) {
                      pass.set_culling(culling, mirrored);
                      pass.draw(pipeline, geometry.args(), 3);
                    });
    commands.copy(image, texels);
  });
  return texels.read();
}

TEST(GpuImage, DrawsWithRowZeroOnTop) {
  const std::vector<vec4> texels = draw(test_context(), upper_left, gpu::Culling::none, false);
  EXPECT_EQ(texels[0], vec4(1, 2, 3, 4));
  EXPECT_EQ(texels[7 * 8 + 7], vec4(0));
}

TEST(GpuImage, CounterClockwiseIsFront) {
  const auto shows = [](const Triangle& triangle, gpu::Culling culling, bool mirrored) {
    return draw(test_context(), triangle, culling, mirrored)[0] != vec4(0);
  };
  Triangle clockwise = upper_left;
  std::swap(clockwise.positions[1], clockwise.positions[2]);
  EXPECT_TRUE(shows(upper_left, gpu::Culling::back, false));
  EXPECT_FALSE(shows(upper_left, gpu::Culling::front, false));
  EXPECT_FALSE(shows(upper_left, gpu::Culling::back, true));
  EXPECT_FALSE(shows(clockwise, gpu::Culling::back, false));
  EXPECT_TRUE(shows(clockwise, gpu::Culling::front, false));
}

TEST(GpuImage, BlendsAsItsNameSays) {
  const Image image(test_context(), {.width = 8, .height = 8, .format = Format::rgba32_float});
  const Geometry geometry(test_context(), {upper_left.positions, {0.5f, 1, 2, 0.25f}});
  const Buffer<vec4> texels(test_context(), 64);
  const auto blended = [&](gpu::Blend blend) {
    gpu::RasterOptions options = color_only(Format::rgba32_float);
    options.blends = {blend};
    const Pipeline pipeline = make_pipeline(test_context(), options);
    test_context().run([&](Commands& commands) {
      commands.render({.colors = {{.image = &image, .clear = {{4, 4, 4, 1}}}}, .depth = {}},
                      [&](gpu::RenderPass& pass) { pass.draw(pipeline, geometry.args(), 3); });
      commands.copy(image, texels);
    });
    return texels.read()[0];
  };
  EXPECT_EQ(blended(gpu::Blend::replace), vec4(0.5f, 1, 2, 0.25f));
  EXPECT_EQ(blended(gpu::Blend::source_over), vec4(3.125f, 3.25f, 3.5f, 1));  // c * .25 + 4 * .75
  EXPECT_EQ(blended(gpu::Blend::premultiplied_over), vec4(3.5f, 4, 5, 1));    // c + 4 * .75
  EXPECT_EQ(blended(gpu::Blend::add), vec4(4.5f, 5, 6, 1.25f));
}

TEST(GpuImage, DepthIsTestedCopiedAndSampled) {
  gpu::Context& context = test_context();
  const Image color(context, {.width = 8, .height = 8, .format = Format::rgba32_float});
  const Image depth(context, {.width = 8, .height = 8, .format = Format::d32_float});
  const Image inverted(context, {.width = 8, .height = 8, .format = Format::rgba32_float});
  gpu::RasterOptions options = color_only(Format::rgba32_float);
  options.depth = Format::d32_float;
  const Pipeline pipeline = make_pipeline(context, options);
  const Kernel<TestSamplesArgs> invert(context, gpu::shaders::core_test_invert_comp);
  const Geometry near(context, upper_left);
  Triangle behind = left_of_middle;
  for (vec4& p : behind.positions) p.z = 0.5f;
  const Geometry far(context, behind);
  const Buffer<float> depths(context, 64);
  const Buffer<vec4> texels(context, 128);
  const Buffer<vec4> unused(context, 1);
  context.run([&](Commands& commands) {
    commands.render({.colors = {{.image = &color, .clear = {{0, 0, 0, 0}}}},
                     .depth = gpu::DepthTarget{.image = &depth, .clear = 1}},
                    [&](gpu::RenderPass& pass) {
                      pass.draw(pipeline, near.args(), 3);
                      pass.draw(pipeline, far.args(), 3);
                    });
    commands.copy(depth, depths);
    commands.copy(color, texels);
    commands.dispatch(
        invert, {8, 8}, {unused, 8, 8, 1},
        std::array{gpu::ImageBinding{&depth}, gpu::ImageBinding{}, gpu::ImageBinding{&inverted}});
  });
  const std::vector<float> d = depths.read();
  EXPECT_EQ(d[0], 0.25f);         // near hides far
  EXPECT_EQ(d[7 * 8], 0.5f);      // far alone
  EXPECT_EQ(d[7 * 8 + 7], 1.0f);  // neither
  EXPECT_EQ(texels.read(0, 1)[0], vec4(1, 2, 3, 4));
  context.run([&](Commands& commands) { commands.copy(inverted, texels); });
  EXPECT_EQ(texels.read()[7 * 8].x, 0.5f);
  EXPECT_EQ(texels.read()[0].x, 0.75f);
}

TEST(GpuImage, KernelsReadEverySampleAndResolveAverages) {
  gpu::Context& context = test_context();
  const Image image(context,
                    {.width = 8, .height = 8, .samples = 4, .format = Format::rgba32_float});
  const Image resolved(context, {.width = 8, .height = 8, .format = Format::rgba32_float});
  gpu::RasterOptions options = color_only(Format::rgba32_float);
  options.samples = 4;
  const Pipeline pipeline = make_pipeline(context, options);
  const Kernel<TestSamplesArgs> fetch(context, gpu::shaders::core_test_samples_comp);
  const Geometry geometry(context, left_of_middle);
  const Buffer<vec4> samples(context, 8 * 8 * 4);
  const Buffer<vec4> texels(context, 64);
  context.run([&](Commands& commands) {
    commands.render(
        {.colors = {{.image = &image, .clear = {{0, 0, 0, 0}}, .resolve = &resolved}}, .depth = {}},
        [&](gpu::RenderPass& pass) { pass.draw(pipeline, geometry.args(), 3); });
    commands.dispatch(fetch, {8, 8}, {samples, 8, 8, 4}, std::array{gpu::ImageBinding{&image}});
    commands.copy(resolved, texels);
  });
  // Vulkan's standard places: x of the four samples is .375, .875, .125, .625; the edge is at 4.5.
  const std::vector<vec4> read = samples.read();
  for (int y = 0; y < 8; ++y) {
    const std::size_t row = static_cast<std::size_t>(y) * 8;
    const auto covered = [&](std::size_t x, std::size_t s) {
      return read[(row + x) * 4 + s].x == 1;
    };
    for (std::size_t s = 0; s < 4; ++s) {
      EXPECT_TRUE(covered(3, s));
      EXPECT_EQ(covered(4, s), s == 0 || s == 2) << "sample " << s;
      EXPECT_FALSE(covered(5, s));
    }
    EXPECT_EQ(texels.read(row + 4, 1)[0], vec4(0.5f));
  }
}

TEST(GpuImage, IndexedDrawsCountInstancesFromTheFirst) {
  gpu::Context& context = test_context();
  const Image image(context, {.width = 8, .height = 8, .format = Format::rgba32_float});
  const Pipeline pipeline = make_pipeline(context, color_only(Format::rgba32_float));
  std::vector<vec4> positions{vec4(9)};  // skipped by the vertex offset
  positions.insert(positions.end(), upper_left.positions.begin(), upper_left.positions.end());
  const Buffer<vec4> vertices(context, positions);
  std::vector<vec4> colors(10, vec4(7));
  for (std::size_t i = 1; i < 4; ++i) colors[5 + i] = vec4(5);
  const Buffer<vec4> palette(context, colors);
  const Buffer<std::uint32_t> indices(context, {9, 9, 0, 1, 2});
  const Buffer<vec4> texels(context, 64);
  const auto render = [&](const gpu::IndexedDraw& indexed) {
    context.run([&](Commands& commands) {
      commands.render(
          {.colors = {{.image = &image, .clear = {{0, 0, 0, 0}}}}, .depth = {}},
          [&](gpu::RenderPass& pass) {
            pass.draw_indexed(pipeline, {vertices, palette}, indices, std::array{indexed});
          });
      commands.copy(image, texels);
    });
  };
  render({.index_count = 3, .first_index = 2, .vertex_offset = 1, .first_instance = 5});
  EXPECT_EQ(texels.read()[0], vec4(5));
  EXPECT_THROW(render({.index_count = 3, .first_index = 3}), std::invalid_argument);
  EXPECT_THROW(render({.index_count = 0xFFFFFFFF, .first_index = 4}), std::invalid_argument);
}

TEST(GpuImage, CopiesRoundTripInEveryFormat) {
  for (const Format format :
       {Format::r32_uint, Format::r32_float, Format::rgba8, Format::rgba8_srgb,
        Format::rgba16_float, Format::rgba32_float, Format::d32_float}) {
    const Image image(test_context(), {.width = 13, .height = 5, .format = format});
    std::vector<std::uint32_t> words(13 * 5 * gpu::texel_bytes(format) / 4);
    for (std::size_t i = 0; i < words.size(); ++i)
      words[i] = 0x3C003C00u + static_cast<std::uint32_t>(i);  // finite in every format
    const Buffer<std::uint32_t> in(test_context(), words);
    const Buffer<std::uint32_t> out(test_context(), words.size());
    test_context().run([&](Commands& commands) {
      commands.copy(in, image);
      commands.copy(image, out);
    });
    EXPECT_EQ(out.read(), words) << static_cast<int>(format);
  }
}

TEST(GpuImage, BlitsAverageIntoTheNextLevel) {
  const Image image(test_context(),
                    {.width = 4, .height = 4, .levels = 3, .format = Format::rgba32_float});
  std::vector<vec4> texels;
  for (int i = 0; i < 16; ++i) texels.push_back(vec4(static_cast<float>(i)));
  const Buffer<vec4> base(test_context(), texels);
  const Buffer<vec4> half(test_context(), 4);
  const Buffer<vec4> last(test_context(), 1);
  test_context().run([&](Commands& commands) {
    commands.copy(base, image);
    commands.blit_level(image, 0, 1);
    commands.blit_level(image, 1, 2);
    commands.copy(image, half, 1);
    commands.copy(image, last, 2);
  });
  EXPECT_EQ(half.read(), (std::vector<vec4>{vec4(2.5f), vec4(4.5f), vec4(10.5f), vec4(12.5f)}));
  EXPECT_EQ(last.read()[0], vec4(7.5f));
}

TEST(GpuImage, RefusesWhatCannotBe) {
  gpu::Context& context = test_context();
  EXPECT_THROW(Image(context, {.width = 0, .height = 4}), std::invalid_argument);
  EXPECT_THROW(Image(context, {.width = 4, .height = -1}), std::invalid_argument);
  EXPECT_THROW(Image(context, {.width = 4, .height = 4, .levels = 4}), std::invalid_argument);
  EXPECT_THROW(Image(context, {.width = 4, .height = 4, .samples = 3}), std::invalid_argument);
  EXPECT_THROW(Image(context, {.width = 1 << 28, .height = 1 << 28}), gpu::Error);
  EXPECT_THROW(Image(context, {.width = 4, .height = 4, .samples = 64}), gpu::Error);
}

TEST(GpuImage, RefusesCommandsThatDoNotFit) {
  gpu::Context& context = test_context();
  const Image image(context, {.width = 8, .height = 8, .format = Format::rgba32_float});
  const Image small(context, {.width = 4, .height = 8, .format = Format::rgba32_float});
  const Pipeline bytes = make_pipeline(context, color_only(Format::rgba8));
  const Kernel<TestSamplesArgs> invert(context, gpu::shaders::core_test_invert_comp);
  const Geometry geometry(context, upper_left);
  const Buffer<vec4> few(context, 63);
  const auto refused = [&](const std::function<void(Commands&)>& record) {
    EXPECT_THROW(context.run(record), std::invalid_argument);
  };
  const gpu::RenderTargets targets{.colors = {{.image = &image, .clear = {}}}, .depth = {}};
  refused([&](Commands& commands) { commands.copy(image, few); });
  refused([&](Commands& commands) { commands.copy(image, few, 1); });
  refused([&](Commands& commands) { commands.blit_level(image, 0, 1); });
  refused([&](Commands& commands) { commands.render({}, [](gpu::RenderPass&) {}); });
  refused([&](Commands& commands) {
    commands.render(
        {.colors = {{.image = &image, .clear = {}}, {.image = &small, .clear = {}}}, .depth = {}},
        [](gpu::RenderPass&) {});
  });
  refused([&](Commands& commands) {
    commands.render(targets, [&](gpu::RenderPass& pass) { pass.draw(bytes, geometry.args(), 3); });
  });
  refused([&](Commands& commands) {
    commands.render(targets, [&](gpu::RenderPass&) { commands.fill(few, 0); });
  });
  refused([&](Commands& commands) {
    commands.dispatch(invert, {8, 8}, {few, 8, 8, 1}, std::array{gpu::ImageBinding{&image}});
  });
}

}  // namespace
}  // namespace parity
