#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "cpu_reference/texture/sample.h"
#include "cpu_reference/texture/mip_pyramid.h"

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

}  // namespace
}  // namespace parity
