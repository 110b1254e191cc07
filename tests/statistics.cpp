#include "tests/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

namespace parity {
namespace {

constexpr double tiny = 1e-300;

/// P(a, x) by its series, for x < a + 1. Source: Abramowitz & Stegun 6.5.29.
double gamma_p_series(double a, double x) {
  double term = 1 / a, sum = term;
  for (int n = 1; n < 10'000 && term > sum * 1e-16; ++n) sum += term *= x / (a + n);
  return sum * std::exp(-x + a * std::log(x) - std::lgamma(a));
}

/// Q(a, x) by its continued fraction, for x >= a + 1. Source: Abramowitz & Stegun 6.5.31, evaluated
/// by Lentz 1976.
double gamma_q_fraction(double a, double x) {
  double b = x + 1 - a, c = 1 / tiny, d = 1 / b, h = d;
  for (int i = 1; i < 10'000; ++i) {
    const double factor = -i * (i - a);
    b += 2;
    d = factor * d + b;
    if (std::abs(d) < tiny) d = tiny;
    c = b + factor / c;
    if (std::abs(c) < tiny) c = tiny;
    d = 1 / d;
    h *= d * c;
    if (std::abs(d * c - 1) < 1e-16) break;
  }
  return h * std::exp(-x + a * std::log(x) - std::lgamma(a));
}

/// Density of Student's t.
double student_density(double t, double freedom) {
  const double log_scale = std::lgamma((freedom + 1) / 2) - std::lgamma(freedom / 2) -
                           0.5 * std::log(freedom * std::acos(-1.0));
  return std::exp(log_scale - (freedom + 1) / 2 * std::log1p(t * t / freedom));
}

/// Chance that |t| <= bound, by Simpson's rule in u = atan(t / sqrt(freedom)), where the integrand
/// is smooth and the range is finite.
double student_within(double bound, double freedom) {
  constexpr int steps = 2000;
  const double root = std::sqrt(freedom);
  const double width = std::atan(bound / root) / steps;
  const auto integrand = [&](double u) {
    const double cosine = std::cos(u);
    return student_density(root * std::tan(u), freedom) * root / (cosine * cosine);
  };
  double sum = integrand(0) + integrand(steps * width);
  for (int i = 1; i < steps; ++i) sum += (i % 2 == 1 ? 4 : 2) * integrand(i * width);
  return 2 * sum * width / 3;
}

/// The bound for which student_within is `confidence`.
double student_quantile(double confidence, double freedom) {
  double low = 0, high = 1e6;
  for (int i = 0; i < 100; ++i) {
    const double middle = low < 1e-3 ? high / 2 : std::sqrt(low * high);
    (student_within(middle, freedom) < confidence ? low : high) = middle;
  }
  return high;
}

struct Bins {
  std::vector<double> observed, expected;
};

Bins pooled(std::span<const double> observed, std::span<const double> expected, double least) {
  std::vector<std::size_t> order(observed.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return expected[i]; });
  Bins bins;
  double pool_observed = 0, pool_expected = 0;
  for (std::size_t i : order) {
    const bool pool_is_open = pool_expected > 0 && pool_expected < least;
    if (expected[i] >= least && !pool_is_open) {
      bins.observed.push_back(observed[i]);
      bins.expected.push_back(expected[i]);
      continue;
    }
    pool_observed += observed[i];
    pool_expected += expected[i];
  }
  if (pool_expected > 0 || pool_observed > 0) {
    bins.observed.push_back(pool_observed);
    bins.expected.push_back(pool_expected);
  }
  return bins;
}

void require_histograms(std::span<const double> observed, std::span<const double> expected) {
  if (observed.size() != expected.size())
    throw std::invalid_argument("chi_squared_test: " + std::to_string(observed.size()) +
                                " observed bins, " + std::to_string(expected.size()) + " expected");
  const double observed_sum = std::accumulate(observed.begin(), observed.end(), 0.0);
  const double expected_sum = std::accumulate(expected.begin(), expected.end(), 0.0);
  if (!(std::abs(observed_sum - expected_sum) <= 1e-6 * observed_sum))
    throw std::invalid_argument("chi_squared_test: " + std::to_string(observed_sum) +
                                " were observed, " + std::to_string(expected_sum) + " expected");
}

}  // namespace

double chi_squared_tail(double statistic, int degrees_of_freedom) {
  if (degrees_of_freedom < 1 || !(statistic >= 0))
    throw std::invalid_argument("chi_squared_tail: statistic is " + std::to_string(statistic) +
                                " with " + std::to_string(degrees_of_freedom) +
                                " degrees of freedom");
  if (std::isinf(statistic)) return 0;
  if (statistic == 0) return 1;
  const double a = degrees_of_freedom / 2.0, x = statistic / 2;
  return x < a + 1 ? 1 - gamma_p_series(a, x) : gamma_q_fraction(a, x);
}

ChiSquaredTest chi_squared_test(std::span<const double> observed, std::span<const double> expected,
                                double least) {
  require_histograms(observed, expected);
  ChiSquaredTest test;
  for (std::size_t i = 0; i < observed.size(); ++i)
    if (expected[i] == 0 && observed[i] > 0)
      return {std::numeric_limits<double>::infinity(), static_cast<int>(observed.size()) - 1, 0.0};
  const Bins bins = pooled(observed, expected, least);
  if (bins.observed.size() < 2)
    throw std::invalid_argument("chi_squared_test: fewer than two bins expect enough");
  for (std::size_t i = 0; i < bins.observed.size(); ++i) {
    const double difference = bins.observed[i] - bins.expected[i];
    test.statistic += difference * difference / bins.expected[i];
  }
  test.degrees_of_freedom = static_cast<int>(bins.observed.size()) - 1;
  test.p_value = chi_squared_tail(test.statistic, test.degrees_of_freedom);
  return test;
}

double normal_tails(double z) { return std::erfc(std::abs(z) / std::sqrt(2.0)); }

double sidak(double alpha, std::size_t count) {
  return count == 0 ? alpha : -std::expm1(std::log1p(-alpha) / static_cast<double>(count));
}

ZTest z_test(std::span<const double> estimates, std::span<const double> expectations,
             std::span<const double> variances, double alpha, double variance_floor) {
  if (estimates.size() != expectations.size() || estimates.size() != variances.size())
    throw std::invalid_argument("z_test: " + std::to_string(estimates.size()) + " estimates, " +
                                std::to_string(expectations.size()) + " expectations, " +
                                std::to_string(variances.size()) + " variances");
  ZTest test{.count = estimates.size()};
  const double level = sidak(alpha, test.count);
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const double deviation = std::sqrt(std::max(variances[i], variance_floor));
    const double z = std::abs(estimates[i] - expectations[i]) / deviation;
    if (!(normal_tails(z) >= level) || std::isnan(variances[i])) ++test.rejected;
    if (z > test.largest_z) test.largest_z = z;
  }
  return test;
}

double PowerFit::at(double x) const { return factor * std::pow(x, slope); }

PowerFit fit_power(std::span<const dvec2> points, double confidence) {
  std::vector<dvec2> logs;
  for (dvec2 p : points)
    if (p.x > 0 && p.y > 0 && std::isfinite(p.x) && std::isfinite(p.y))
      logs.push_back({std::log(p.x), std::log(p.y)});
  const double n = static_cast<double>(logs.size());
  const dvec2 mean = std::accumulate(logs.begin(), logs.end(), dvec2{0.0}) / n;
  double xx = 0, xy = 0;
  for (dvec2 p : logs) {
    xx += (p.x - mean.x) * (p.x - mean.x);
    xy += (p.x - mean.x) * (p.y - mean.y);
  }
  if (logs.size() < 2 || xx <= 0)
    throw std::invalid_argument("fit_power: " + std::to_string(logs.size()) +
                                " usable points, needs two at different x");
  PowerFit fit{.slope = xy / xx, .count = logs.size()};
  fit.factor = std::exp(mean.y - fit.slope * mean.x);
  double residual = 0;
  for (dvec2 p : logs) {
    const double miss = p.y - mean.y - fit.slope * (p.x - mean.x);
    residual += miss * miss;
  }
  fit.slope_margin = logs.size() == 2
                         ? std::numeric_limits<double>::infinity()
                         : student_quantile(confidence, n - 2) * std::sqrt(residual / (n - 2) / xx);
  return fit;
}

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::ranges::sort(values);
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

std::vector<std::size_t> pareto_front(std::span<const dvec2> points) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!std::isnan(points[i].x) && !std::isnan(points[i].y)) order.push_back(i);
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
    return points[a].x != points[b].x ? points[a].x < points[b].x : points[a].y < points[b].y;
  });
  std::vector<std::size_t> front;
  for (std::size_t i : order)
    if (front.empty() || points[i].y < points[front.back()].y) front.push_back(i);
  return front;
}

}  // namespace parity
