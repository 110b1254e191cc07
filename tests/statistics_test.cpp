#include "tests/statistics.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "geometry/random.h"

namespace parity {
namespace {

TEST(ChiSquared, TailHasTheClosedFormForTwoDegrees) {
  for (double x : {0.1, 1.0, 3.0, 10.0, 60.0})
    EXPECT_NEAR(chi_squared_tail(x, 2) / std::exp(-x / 2), 1, 1e-12);
}

TEST(ChiSquared, TailOfOneDegreeIsThatOfTheNormal) {
  for (double z : {0.3, 1.0, 1.96, 4.0})
    EXPECT_NEAR(chi_squared_tail(z * z, 1) / normal_tails(z), 1, 1e-10);
}

// Abramowitz & Stegun, table 26.8: the 5 % and 0.1 % points.
TEST(ChiSquared, TailAgreesWithTheTable) {
  EXPECT_NEAR(chi_squared_tail(18.3070, 10), 0.05, 1e-6);
  EXPECT_NEAR(chi_squared_tail(124.342, 100), 0.05, 1e-6);
  // Three decimals of the point are 1e-7 of the chance.
  EXPECT_NEAR(chi_squared_tail(149.449, 100), 0.001, 1e-7);
}

/// 10,000 throws of a die with that chance of a six.
ChiSquaredTest throw_dice(double chance_of_six) {
  std::array<double, 6> observed{};
  Random random(7);
  for (int i = 0; i < 10'000; ++i)
    observed[random.uniform() < chance_of_six ? 5 : random.below(5)] += 1;
  const std::vector<double> expected(6, 10'000 / 6.0);
  return chi_squared_test(observed, expected);
}

TEST(ChiSquared, AcceptsAFairDieAndRejectsALoadedOne) {
  EXPECT_GT(throw_dice(1 / 6.0).p_value, 0.01);
  EXPECT_LT(throw_dice(1 / 6.0 + 0.02).p_value, 1e-4);
}

TEST(ChiSquared, PoolsBinsThatExpectLittle) {
  const std::array expected{100.0, 2.0, 2.0, 2.0, 100.0};
  const std::array observed{101.0, 1.0, 3.0, 1.0, 100.0};
  EXPECT_EQ(chi_squared_test(observed, expected).degrees_of_freedom, 2);
}

TEST(ChiSquared, NothingMayFallWhereNothingIsExpected) {
  const std::array expected{50.0, 50.0, 0.0};
  const std::array observed{50.0, 49.0, 1.0};
  EXPECT_EQ(chi_squared_test(observed, expected).p_value, 0);
}

TEST(ChiSquared, RefusesOtherSums) {
  EXPECT_THROW(chi_squared_test(std::array{1.0, 2.0}, std::array{1.0, 3.0}), std::invalid_argument);
}

TEST(ZTest, RejectsABiasOfFiveDeviations) {
  const std::array expected{1.0, 1.0, 1.0};
  const std::array variance{0.01, 0.01, 0.01};
  EXPECT_EQ(z_test(std::array{1.0, 1.1, 0.9}, expected, variance, 0.01, 1e-12).rejected, 0u);
  EXPECT_EQ(z_test(std::array{1.0, 1.5, 0.9}, expected, variance, 0.01, 1e-12).rejected, 1u);
}

TEST(ZTest, RejectsNan) {
  const double nan = std::nan("");
  const std::array one{1.0};
  EXPECT_EQ(z_test(std::array{nan}, one, one, 0.01, 1e-4).rejected, 1u);
  EXPECT_EQ(z_test(one, one, std::array{nan}, 0.01, 1e-4).rejected, 1u);
}

TEST(Sidak, ManyTestsTogetherHaveTheLevelOfOne) {
  const double level = sidak(0.01, 1'000'000);
  EXPECT_NEAR(1 - std::pow(1 - level, 1e6), 0.01, 1e-8);
}

TEST(PowerFit, FindsAnExactLaw) {
  std::vector<dvec2> points;
  for (double x : {1.0, 2.0, 4.0, 8.0}) points.push_back({x, 3 * std::pow(x, -0.5)});
  const PowerFit fit = fit_power(points);
  EXPECT_NEAR(fit.slope, -0.5, 1e-13);
  EXPECT_NEAR(fit.factor, 3, 1e-12);
  EXPECT_LT(fit.slope_margin, 1e-12);
}

// Points (0,0), (1,1), (2,1) in the logarithms: slope 1/2, residual variance 1/6 on 1 degree of
// freedom, sum of squares of x 2, t(0.975, 1) = 12.7062: the margin is 12.7062 sqrt(1/12).
TEST(PowerFit, MarginIsThatOfStudent) {
  const double e = std::exp(1.0);
  const std::array points{dvec2{1, 1}, dvec2{e, e}, dvec2{e * e, e}};
  const PowerFit fit = fit_power(points);
  EXPECT_NEAR(fit.slope, 0.5, 1e-14);
  EXPECT_NEAR(fit.slope_margin, 12.7062 * std::sqrt(1 / 12.0), 1e-4);
}

TEST(PowerFit, NeedsTwoPlaces) {
  EXPECT_THROW(fit_power(std::array{dvec2{1, 1}, dvec2{1, 2}}), std::invalid_argument);
  EXPECT_THROW(fit_power(std::array{dvec2{1, 1}, dvec2{2, 0}}), std::invalid_argument);
}

TEST(Median, IsInTheMiddle) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 3, 2}), 2.5);
  EXPECT_TRUE(std::isnan(median({})));
}

// (1,2) beats (1,4) and (2,3); (3,1) is the lowest.
TEST(Pareto, KeepsWhatNothingBeats) {
  const std::array points{dvec2{1, 4}, dvec2{1, 2}, dvec2{2, 3}, dvec2{3, 1}, dvec2{NAN, 0}};
  EXPECT_EQ(pareto_front(points), (std::vector<std::size_t>{1, 3}));
}

}  // namespace
}  // namespace parity
