#pragma once

#include <span>
#include <vector>

#include "geometry/math.h"

/// Hypothesis tests and fits. All are deterministic; seeds are the caller's.
namespace parity {

/// Chance that a chi^2 variable of `degrees_of_freedom` exceeds `statistic`: the regularised upper
/// incomplete gamma function Q(k/2, x/2). Relative accuracy 1e-12.
///
/// @throws std::invalid_argument  degrees_of_freedom < 1 or statistic < 0 or NaN.
double chi_squared_tail(double statistic, int degrees_of_freedom);

struct ChiSquaredTest {
  double statistic = 0;
  int degrees_of_freedom = 0;
  double p_value = 1;
};

/// Pearson's test of a histogram against expected counts. Bins that expect less than `least` are
/// pooled into one, in order of expectation, until it expects enough. Counts in a bin that expects
/// 0 make p 0.
///
/// @param expected  as many as observed, >= 0, with the same sum up to 1e-6 relative.
/// @throws std::invalid_argument  sizes or sums differ, or fewer than two bins are left.
///
/// Source: Pearson 1900; pooling as in pbrt-v4, bsdfs_test.
ChiSquaredTest chi_squared_test(std::span<const double> observed, std::span<const double> expected,
                                double least = 5);

/// Two-sided chance that a normal variable is farther from its mean than |z| standard deviations.
double normal_tails(double z);

/// Level of each of `count` independent tests so that all together have level `alpha`:
/// 1 - (1 - alpha)^(1/count), in (0, alpha].
double sidak(double alpha, std::size_t count);

/// What a z-test of many pixels found.
struct ZTest {
  std::size_t rejected = 0;
  std::size_t count = 0;
  double largest_z = 0;
  double passed_share() const { return count == 0 ? 1.0 : 1.0 - double(rejected) / double(count); }
};

/// Each estimate against its expectation, at family level alpha (Sidak).
///
/// @param variances  of the estimates themselves (of the mean, not of a sample); floored at
///                   `variance_floor`. NaN anywhere is a rejection.
ZTest z_test(std::span<const double> estimates, std::span<const double> expectations,
             std::span<const double> variances, double alpha, double variance_floor);

/// y = factor * x^slope, fitted by least squares to the logarithms.
struct PowerFit {
  double slope = 0;
  double factor = 0;
  double slope_margin =
      0;  ///< half width of the confidence interval of the slope; infinite for 2 points
  std::size_t count = 0;  ///< points used: those with x, y > 0 and finite
  double at(double x) const;
};

/// @param confidence  in (0, 1), for slope_margin.
/// @throws std::invalid_argument  fewer than two usable points, or all at one x.
PowerFit fit_power(std::span<const dvec2> points, double confidence = 0.95);

/// Middle value; the mean of the middle two for an even count. NaN for none.
double median(std::vector<double> values);

/// Indices of the points that no other beats in both x and y (smaller is better), by rising x.
/// Points with NaN are left out.
std::vector<std::size_t> pareto_front(std::span<const dvec2> points);

}  // namespace parity
