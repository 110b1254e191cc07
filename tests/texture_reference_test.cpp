#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "cpu_reference/texture/answers.h"
#include "cpu_reference/texture/mip_pyramid.h"
#include "cpu_reference/texture/sample.h"
#include "cpu_reference/texture/texel.h"
#include "gpu/texture/sample.h"
#include "tests/gpu_context.h"
#include "tests/texture/errata_texture.h"
#include "tests/texture/textures.h"

namespace parity {
namespace {

using cpu::MippedTexture;

/// Red of texel (x, y) is 10 (x + 4 y).
std::vector<Grid<u8vec4>> ramp() {
  Grid<u8vec4> image{4, 4};
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) image(x, y) = u8vec4(u8vec4::value_type(10 * (x + 4 * y)));
  return {image};
}

double code(const MippedTexture& t, double u, double v, double lambda = 0) {
  return cpu::sample(t, {u, v}, lambda).value.x * 255.0;
}

Sampler sampler(Wrap wrap, Filter filter) {
  return {.wrap_u = wrap, .wrap_v = wrap, .mag = filter, .min = filter, .mip = {}};
}

// Sums of four products of doubles around 100: 1e-12.
constexpr double rounding = 1e-12;

TEST(CpuTexture, NearestTakesTheTexelThatHoldsThePoint) {
  const auto levels = ramp();
  const MippedTexture t{levels, false, sampler(Wrap::repeat, Filter::nearest)};
  EXPECT_NEAR(code(t, 0.24, 0.0), 0, rounding);
  EXPECT_NEAR(code(t, 0.25, 0.0), 10, rounding);
  EXPECT_NEAR(code(t, 0.99, 0.99), 150, rounding);
}

TEST(CpuTexture, WrapsByItsMode) {
  const auto levels = ramp();
  const MippedTexture repeat{levels, false, sampler(Wrap::repeat, Filter::nearest)};
  EXPECT_NEAR(code(repeat, -0.1, 0.1), 30, rounding);
  EXPECT_NEAR(code(repeat, 5.3, 0.1), 10, rounding);
  const MippedTexture mirror{levels, false, sampler(Wrap::mirrored_repeat, Filter::nearest)};
  EXPECT_NEAR(code(mirror, -0.1, 0.1), 0, rounding);
  EXPECT_NEAR(code(mirror, 1.1, 0.1), 30, rounding);
  EXPECT_NEAR(code(mirror, -1.1, 0.1), 30, rounding);
  EXPECT_NEAR(code(mirror, 2.3, 0.1), 10, rounding);
  const MippedTexture clamp{levels, false, sampler(Wrap::clamp_to_edge, Filter::nearest)};
  EXPECT_NEAR(code(clamp, -7, 0.1), 0, rounding);
  EXPECT_NEAR(code(clamp, 7, 0.1), 30, rounding);
  const MippedTexture once{levels, false, sampler(Wrap::mirror_clamp_to_edge, Filter::nearest)};
  EXPECT_NEAR(code(once, -0.1, 0.1), 0, rounding);
  EXPECT_NEAR(code(once, -0.6, 0.1), 20, rounding);
  EXPECT_NEAR(code(once, -7, 0.1), 30, rounding) << "the mirrored far edge";
  EXPECT_NEAR(code(once, 7, 0.1), 30, rounding);
}

TEST(CpuTexture, ABorderIsTransparentBlack) {
  const auto levels = ramp();
  const MippedTexture nearest{levels, false, sampler(Wrap::clamp_to_border, Filter::nearest)};
  for (const dvec2 outside : {dvec2(-0.001, 0.9), dvec2(1, 0.9), dvec2(0.9, -0.001), dvec2(0.9, 1),
                              dvec2(7, 0.9), dvec2(-7, -7)})
    EXPECT_EQ(cpu::sample(nearest, outside, 0).value, dvec4(0)) << outside.x << ", " << outside.y;
  for (const dvec2 inside : {dvec2(0.999, 0.999), dvec2(0.75, 0.75)})
    EXPECT_NEAR(cpu::sample(nearest, inside, 0).value.w * 255, 150, rounding);
  // All of a side's texel at its centre, half of it on the border, nothing half a texel outside.
  const MippedTexture linear{levels, false, sampler(Wrap::clamp_to_border, Filter::linear)};
  EXPECT_NEAR(code(linear, 0.875, 0.875), 150, rounding);
  EXPECT_NEAR(code(linear, 1, 0.875), 75, rounding);
  EXPECT_NEAR(code(linear, 1, 1), 37.5, rounding) << "a corner: three of four are the border";
  EXPECT_NEAR(code(linear, 1.0625, 0.875), 150 / 4.0, rounding);
  EXPECT_EQ(code(linear, 1.125, 0.875), 0);
  EXPECT_NEAR(code(linear, 0, 0.875), 120 / 2.0, rounding);
  EXPECT_EQ(code(linear, -0.125, 0.875), 0);
  EXPECT_NEAR(code(linear, 0.875, 0), 30 / 2.0, rounding);
}

TEST(CpuTexture, LinearMixesFourTexelsByTheirDistance) {
  const auto levels = ramp();
  const MippedTexture t{levels, false, sampler(Wrap::clamp_to_edge, Filter::linear)};
  EXPECT_NEAR(code(t, 0.375, 0.375), 50, rounding) << "a texel's centre";
  EXPECT_NEAR(code(t, 0.5, 0.375), 55, rounding);
  EXPECT_NEAR(code(t, 0.4375, 0.4375), 50 + 2.5 + 10, rounding);
  EXPECT_NEAR(code(t, 0.0, 0.0), 0, rounding);
  const MippedTexture r{levels, false, sampler(Wrap::repeat, Filter::linear)};
  EXPECT_NEAR(code(r, 0.0, 0.125), 15, rounding) << "halfway between the last and the first";
}

TEST(CpuTexture, DecodesBeforeItFilters) {
  Grid<u8vec4> image{2, 1};
  image(1, 0) = u8vec4(255);
  const std::vector<Grid<u8vec4>> levels{image};
  const MippedTexture t{levels, true, sampler(Wrap::clamp_to_edge, Filter::linear)};
  EXPECT_NEAR(cpu::sample(t, {0.5, 0.5}, 0).value.x, 0.5, rounding);
}

TEST(CpuTexture, DecodesSrgbByTheStandard) {
  EXPECT_EQ(cpu::linear_from_srgb_code(0), 0.0);
  EXPECT_EQ(cpu::linear_from_srgb_code(255), 1.0);
  EXPECT_NEAR(cpu::linear_from_srgb_code(10), 10 / 255.0 / 12.92, 1e-15);
  EXPECT_NEAR(cpu::linear_from_srgb_code(128), 0.21586050011389926, 1e-15);
}

/// Level k of 0..3 holds the code 40 k everywhere.
std::vector<Grid<u8vec4>> steps() {
  std::vector<Grid<u8vec4>> levels;
  for (int k = 0; k < 4; ++k)
    levels.emplace_back(8 >> k, 8 >> k, u8vec4(u8vec4::value_type(40 * k)));
  return levels;
}

TEST(CpuTexture, ChoosesOrMixesLevelsByTheMipMode) {
  const auto levels = steps();
  MippedTexture t{levels, false, {}};
  t.sampler.mip = Filter::linear;
  EXPECT_NEAR(code(t, 0.3, 0.3, -1), 0, rounding);
  EXPECT_NEAR(code(t, 0.3, 0.3, 0.25), 10, rounding);
  EXPECT_NEAR(code(t, 0.3, 0.3, 1.5), 60, rounding);
  EXPECT_NEAR(code(t, 0.3, 0.3, 9), 120, rounding);
  t.sampler.mip = Filter::nearest;
  EXPECT_NEAR(code(t, 0.3, 0.3, 0.5), 0, rounding) << "ceil(1) - 1";
  EXPECT_NEAR(code(t, 0.3, 0.3, 0.51), 40, rounding);
  EXPECT_NEAR(code(t, 0.3, 0.3, 2.5), 80, rounding);
  EXPECT_NEAR(code(t, 0.3, 0.3, 1e30), 120, rounding);
  t.sampler.mip.reset();
  EXPECT_NEAR(code(t, 0.3, 0.3, 2.5), 0, rounding);
}

TEST(CpuTexture, MeasuresTheFootprintInTexels) {
  EXPECT_NEAR(cpu::level_of_detail({0.25, 0}, {0, 0.125}, 16, 16), 2, 1e-15);
  EXPECT_NEAR(cpu::level_of_detail({0.03, 0.04}, {0, 0}, 100, 100), std::log2(5.0), 1e-14);
  EXPECT_LT(cpu::level_of_detail({0, 0}, {0, 0}, 16, 16), 0);
}

TEST(CpuTexture, SurvivesCoordinatesThatAreNotFinite) {
  const auto levels = cpu::mip_pyramid(ramp()[0], false);
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Filter filter : {Filter::nearest, Filter::linear})
    for (const double bad : {infinity, -infinity, std::nan(""), 1e300, -1e300}) {
      const MippedTexture t{levels, false, sampler(Wrap::mirrored_repeat, filter)};
      EXPECT_TRUE(std::isfinite(cpu::sample(t, {bad, bad}, 0).value.x)) << bad;
      EXPECT_TRUE(std::isfinite(cpu::sample({levels, false, {}}, {bad, bad}, bad).value.x));
    }
  EXPECT_FALSE(std::isnan(cpu::level_of_detail({std::nan(""), 0}, {0, 0}, 4, 4)));
}

/// The device's level of detail, as a texture of levels tells it. 8-bit codes of 16 a level.
double device_level(dvec2 dx, dvec2 dy, int width, int height) {
  std::vector<Grid<u8vec4>> levels;
  for (int k = 0; std::max(width, height) >> k > 0; ++k)
    levels.emplace_back(std::max(1, width >> k), std::max(1, height >> k),
                        u8vec4(u8vec4::value_type(16 * k)));
  const TextureFootprint f[] = {{{0.3f, 0.3f}, vec2(dx), vec2(dy)}};
  return gpu::sample(test_context(), {levels, false, {}}, f, 0.5f)[0].x * 255.0 / 16;
}

TEST(TextureErrata, LevelOfDetailCountsTexelsInBothDirections) {
  EXPECT_TRUE(measures_texels_a_pixel(cpu::level_of_detail));
  EXPECT_TRUE(measures_texels_a_pixel(device_level));
  EXPECT_FALSE(measures_texels_a_pixel([](dvec2 dx, dvec2, int, int) {
    return std::log2(std::max(std::abs(dx.x), std::abs(dx.y)));  // notes 6.3
  }));
  EXPECT_FALSE(measures_texels_a_pixel([](dvec2 dx, dvec2 dy, int width, int height) {
    const dvec2 x = glm::abs(dx * dvec2(width, height)), y = glm::abs(dy * dvec2(width, height));
    return std::log2(std::max({x.x, x.y, y.x, y.y}));  // with size and y, but not turned
  }));
}

TEST(TextureErrata, TexelsHaveTheirValueInTheirMiddle) {
  const auto row_of = [](const std::vector<double>& texels) {
    Grid<u8vec4> image{int(texels.size()), 1};
    for (std::size_t i = 0; i < texels.size(); ++i) image(int(i), 0).x = std::uint8_t(texels[i]);
    return image;
  };
  EXPECT_TRUE(reads_a_ramp_as_a_ramp([&](const std::vector<double>& texels, double u) {
    const std::vector<Grid<u8vec4>> levels{row_of(texels)};
    return 255 * cpu::sample({levels, false, {.wrap_u = Wrap::clamp_to_edge}}, {u, 0.5}, 0).value.x;
  }));
  EXPECT_FALSE(reads_a_ramp_as_a_ramp([](const std::vector<double>& texels, double u) {
    const double place = u * double(texels.size());  // notes 6.3: no half
    const auto i = std::min(std::size_t(place), texels.size() - 1);
    const double share = place - double(i);
    return (1 - share) * texels[i] + share * texels[std::min(i + 1, texels.size() - 1)];
  }));
}

TEST(TextureErrata, OddLevelsKeepTheMean) {
  EXPECT_TRUE(keeps_the_mean([](const std::vector<double>& row) {
    Grid<u8vec4> image{int(row.size()), 1};
    for (std::size_t i = 0; i < row.size(); ++i) image(int(i), 0).x = std::uint8_t(row[i]);
    std::vector<double> half;
    const std::vector<Grid<dvec4>> means = cpu::mip_means(image, false);
    for (const dvec4& mean : means[1]) half.push_back(mean.x);
    return half;
  }));
  EXPECT_FALSE(keeps_the_mean([](const std::vector<double>& row) {
    std::vector<double> half;
    for (std::size_t i = 0; i + 1 < row.size(); i += 2) half.push_back((row[i] + row[i + 1]) / 2);
    return half;
  }));
}

TEST(TextureErrata, TheLastPlaceHasATexel) {
  EXPECT_TRUE(finds_a_texel_everywhere([](double u, int size) {
    return *cpu::wrap_texel(std::int64_t(std::floor(u * size)), size, Wrap::clamp_to_edge);
  }));
  EXPECT_FALSE(finds_a_texel_everywhere(
      [](double u, int size) { return int(std::floor(u * size)); }));  // notes 6.3
}

TEST(SamplerAnswers, RejectAShiftedTexture) {
  Random random{5};
  const std::vector<Grid<u8vec4>> levels{texture_test::random_image(16, 16, random)};
  const MippedTexture t{levels, false, {.mip = {}}};
  const cpu::SamplerPrecision precision{.texel_weight = 0x1p-8};
  const dvec2 uv{0.31, 0.62};
  const auto answers = cpu::sample_answers(t, uv, {-1, -1}, precision);
  EXPECT_EQ(cpu::distance_to(answers, cpu::sample(t, uv, -1).value), 0);
  EXPECT_LT(cpu::distance_to(answers, cpu::sample(t, uv + 0.5 / 256 / 16, -1).value), 1e-12);
  EXPECT_GT(cpu::distance_to(answers, cpu::sample(t, uv + 0.5 / 16, -1).value), 0.01);
}

TEST(MipPyramid, KeepsTheMeanOfAnOddImage) {
  Grid<u8vec4> image{5, 3};
  for (int i = 0; i < 15; ++i)
    image.values()[std::size_t(i)] = u8vec4(i * 17, 255 - i * 17, i % 2 * 255, 255);
  double mean = 0;
  for (const u8vec4& t : image) mean += t.x / 15.0;
  const auto means = cpu::mip_means(image, false);
  ASSERT_EQ(means.size(), 3u);  // 5x3, 2x1, 1x1
  EXPECT_EQ(means[1].width(), 2);
  EXPECT_EQ(means[1].height(), 1);
  EXPECT_NEAR(means[2](0, 0).x, mean, 1e-12);
}

TEST(MipPyramid, AveragesInLinearLight) {
  Grid<u8vec4> image{2, 1};
  image(1, 0) = u8vec4(255);
  EXPECT_EQ(cpu::mip_pyramid(image, true)[1](0, 0).x, 188);  // sRGB code of linear 0.5
  EXPECT_EQ(cpu::mip_pyramid(image, false)[1](0, 0).x, 128);
  EXPECT_THROW(cpu::mip_pyramid({}, true), std::invalid_argument);
}

}  // namespace
}  // namespace parity
