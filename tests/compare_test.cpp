#include "tests/compare.h"

#include <gtest/gtest.h>

#include <numbers>

#include "geometry/random.h"

namespace parity {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

TEST(Ulp, CountsFloatsAcrossZero) {
  EXPECT_EQ(ulp_distance(1.0f, 1.0f), 0u);
  EXPECT_EQ(ulp_distance(0.0f, -0.0f), 0u);
  EXPECT_EQ(ulp_distance(1.0f, std::nextafter(1.0f, 2.0f)), 1u);
  EXPECT_EQ(ulp_distance(-1e-45f, 1e-45f), 2u);
  EXPECT_EQ(ulp_distance(1.0f, 2.0f), 1u << 23);
  EXPECT_EQ(ulp_distance(1.0, 2.0), 1ull << 52);
  EXPECT_EQ(ulp_distance(-1.0, 1.0), 2 * ulp_distance(0.0, 1.0));
}

TEST(Ulp, NanIsFarFromEverything) {
  EXPECT_GT(ulp_distance(nan, 1.0f), 1u << 30);
  EXPECT_GT(ulp_distance(1.0, std::nan("")), 1ull << 60);
  EXPECT_EQ(ulp_distance(nan, nan), 0u);
}

TEST(Difference, OfNanOrOtherLengthIsInfinite) {
  const std::vector<float> one{1.0f, 2.0f}, spoiled{1.0f, nan}, longer{1.0f, 2.0f, 3.0f};
  EXPECT_EQ(largest_difference(one, one), 0);
  EXPECT_TRUE(std::isinf(largest_difference(spoiled, one)));
  EXPECT_TRUE(std::isinf(largest_difference(longer, one)));
  EXPECT_EQ(count_differences(spoiled, one), 1);
  EXPECT_EQ(largest_difference(std::vector<float>{inf}, std::vector<float>{inf}), 0);
}

/// A chain of every basic operation in float, as the host computes it.
template <typename T>
T chain(T a, T b, T c) {
  return (a * b + c) / (a * a + T(1.0f)) - b;
}

TEST(Interval, HoldsWhatTheHostComputes) {
  Random random(3);
  for (int i = 0; i < 10'000; ++i) {
    const float a = random.uniform(-8, 8), b = random.uniform(-8, 8), c = random.uniform(-8, 8);
    const Interval accepted = chain<Interval>(a, b, c);
    EXPECT_TRUE(accepted.contains(chain<float>(a, b, c)));
    EXPECT_FALSE(accepted.contains(accepted.high() * 1.00001f + 1e-3f));
  }
}

TEST(Interval, SumAcceptsBothNeighboursAndNoMore) {
  const Interval sum = Interval(1.0f) + Interval(0x1p-30f);
  EXPECT_TRUE(sum.contains(1.0f));
  EXPECT_TRUE(sum.contains(std::nextafter(1.0f, 2.0f)));
  EXPECT_FALSE(sum.contains(1.0f + 0x1p-22f));
  EXPECT_FALSE(sum.contains(std::nextafter(1.0f, 0.0f)));
  const Interval exact = Interval(1.0f) + Interval(2.0f);
  EXPECT_EQ(exact.low(), exact.high());
}

TEST(Interval, QuotientIsWithinTwoAndAHalfUlp) {
  const Interval third = Interval(1.0f) / Interval(3.0f);
  const float nearest = 1.0f / 3.0f;
  EXPECT_TRUE(third.contains(nearest + 2 * 0x1p-25f));
  EXPECT_FALSE(third.contains(nearest + 4 * 0x1p-25f));
}

TEST(Interval, FunctionsHoldTheHostsOwn) {
  Random random(5);
  for (int i = 0; i < 10'000; ++i) {
    const float x = random.uniform(0.01f, 3.0f), y = random.uniform(-2, 2);
    EXPECT_TRUE(sqrt(Interval(x)).contains(std::sqrt(x)));
    EXPECT_TRUE(inverse_sqrt(Interval(x)).contains(1 / std::sqrt(x)));
    EXPECT_TRUE(exp2(Interval(y)).contains(std::exp2(y)));
    EXPECT_TRUE(log2(Interval(x)).contains(std::log2(x)));
    EXPECT_TRUE(pow(Interval(x), Interval(y)).contains(std::pow(x, y)));
    EXPECT_TRUE(sin(Interval(x)).contains(std::sin(x)));
    EXPECT_TRUE(cos(Interval(y)).contains(std::cos(y)));
    EXPECT_TRUE(atan(Interval(y)).contains(std::atan(y)));
    EXPECT_TRUE(acos(Interval(y / 2)).contains(std::acos(y / 2)));
  }
}

TEST(Interval, FunctionsRejectThreeBoundsAway) {
  EXPECT_FALSE(sin(Interval(1.0f)).contains(std::sin(1.0f) + 3 * 0x1p-11f));
  EXPECT_FALSE(cos(Interval(0.0f)).contains(1 - 3 * 0x1p-11f));
  EXPECT_FALSE(log2(Interval(1.0f)).contains(3 * 0x1p-21f));
  EXPECT_FALSE(exp2(Interval(0.0f)).contains(1 + 9 * 0x1p-23f));
  EXPECT_FALSE(inverse_sqrt(Interval(1.0f)).contains(1 + 6 * 0x1p-23f));
}

TEST(Interval, SubnormalsMayBeFlushed) {
  const Interval product = Interval(0x1p-80f) * Interval(0x1p-60f);
  EXPECT_TRUE(product.contains(0.0f));
  EXPECT_TRUE(product.contains(0x1p-140f));
  EXPECT_FALSE(product.contains(0x1p-120f));
}

TEST(Interval, NothingIsPromisedOutsideADomain) {
  EXPECT_TRUE((Interval(1.0f) / Interval(0.0f)).contains(nan));
  EXPECT_TRUE(log2(Interval(-1.0f)).contains(nan));
  EXPECT_TRUE((Interval(3e38f) * Interval(10.0f)).contains(inf));
  EXPECT_FALSE((Interval(1.0f) + Interval(1.0f)).contains(nan));
}

TEST(Interval, SineKnowsItsPeak) {
  const Interval around_peak = sin(Interval::between(1.5, 1.7));
  EXPECT_TRUE(around_peak.contains(1.0f));
  EXPECT_LT(around_peak.high(), 1.001);
}

Picture picture() {
  Picture p;
  p.color = Grid<vec4>(3, 2, vec4{0.5f, 0.5f, 0.5f, 1.0f});
  p.depth = Grid<float>(3, 2, 0.25f);
  p.element = Grid<std::uint32_t>(3, 2, 1);
  return p;
}

TEST(Census, NamesTheCause) {
  Picture got = picture();
  got.element(0, 0) = 2;
  got.color(0, 0) = vec4{9.0f};  // counted as coverage only
  got.depth(1, 0) = 0.5f;
  got.color(2, 1).y = nan;
  const PixelCensus census = take_census(got, picture(), {});
  EXPECT_EQ(census.coverage, 1u);
  EXPECT_EQ(census.depth, 1u);
  EXPECT_EQ(census.color, 1u);
  EXPECT_EQ(census.text(), "3 of 6 pixels: coverage 1, depth 1, colour 1; first at (0, 0)");
}

TEST(Census, LimitsAreInclusive) {
  Picture got = picture();
  got.color(0, 0).x = 0.625f;
  got.depth(1, 1) = 0.375f;
  EXPECT_EQ(take_census(got, picture(), {.depth = 0.125f, .color = vec4{0.125f}}).wrong(), 0u);
  EXPECT_EQ(take_census(got, picture(), {.depth = 0.12f, .color = vec4{0.12f}}).wrong(), 2u);
}

TEST(Census, BackgroundOnOneSideIsCoverage) {
  Picture got = picture();
  got.color(1, 1) = vec4{0.0f};
  EXPECT_EQ(take_census(got, picture(), {}).coverage, 1u);
}

TEST(Census, RefusesOtherSizes) {
  EXPECT_THROW(take_census(Picture{}, picture(), {}), std::invalid_argument);
}

}  // namespace
}  // namespace parity
