#include "tests/compare.h"

#include <algorithm>
#include <bit>
#include <numbers>
#include <stdexcept>

namespace parity {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double smallest_normal = 0x1p-126;
constexpr double largest_float = std::numeric_limits<float>::max();

/// Floats in order as integers in order; both zeros at the same place.
template <typename Signed, typename Unsigned, typename Float>
Signed order_of(Float value) {
  const auto bits = std::bit_cast<Signed>(value);
  return bits >= 0 ? bits : static_cast<Signed>(std::numeric_limits<Signed>::min() - bits);
}

/// Distance between the two floats that bracket x, of the normal range. Source: Harrison.
double ulp_of(double x) {
  const double size = std::max(std::abs(x), smallest_normal);
  return std::ldexp(1.0, std::ilogb(size) - 23);
}

double float_below(double x) {
  if (x < -largest_float) return -infinity;
  if (x > largest_float) return largest_float;
  const float near = static_cast<float>(x);
  return near <= x ? near : std::nextafter(near, -std::numeric_limits<float>::infinity());
}

double float_above(double x) { return -float_below(-x); }

/// Results in the subnormal range may be flushed to 0; those beyond the range may be anything.
Interval settle(double low, double high) {
  if (std::isnan(low) || std::isnan(high)) return Interval::everything();
  low = float_below(low);
  high = float_above(high);
  if (std::isinf(low) || std::isinf(high)) return Interval::everything();
  if (low > 0 && low < smallest_normal) low = 0;
  if (high < 0 && high > -smallest_normal) high = 0;
  return Interval::between(low, high);
}

Interval widen_ulps(double low, double high, double ulps) {
  return settle(low - ulps * ulp_of(low), high + ulps * ulp_of(high));
}

Interval widen_absolute(double low, double high, double bound) {
  return settle(low - bound, high + bound);
}

Interval log_bounds(Interval x, double low, double high) {
  if (x.accepts_everything() || x.low() <= 0) return Interval::everything();
  const bool near_one = x.high() >= 0.5 && x.low() <= 2;
  const Interval wide = widen_ulps(low, high, 3);
  if (!near_one) return wide;
  const Interval absolute = widen_absolute(low, high, 0x1p-21);
  return Interval::between(std::min(wide.low(), absolute.low()),
                           std::max(wide.high(), absolute.high()));
}

Interval exp_bounds(Interval x, double low, double high) {
  if (x.accepts_everything()) return x;
  const double ulps = 3 + 2 * std::max(std::abs(x.low()), std::abs(x.high()));
  const Interval wide = widen_ulps(low, high, ulps);
  return wide.accepts_everything() ? wide
                                   : Interval::between(std::max(0.0, wide.low()), wide.high());
}

/// Range of the sine over [low, high].
std::pair<double, double> sine_range(double low, double high) {
  constexpr double pi = std::numbers::pi;
  const auto holds_peak = [&](double peak) {
    return std::ceil((low - peak) / (2 * pi)) <= std::floor((high - peak) / (2 * pi));
  };
  const double a = std::sin(low), b = std::sin(high);
  return {holds_peak(-pi / 2) ? -1.0 : std::min(a, b), holds_peak(pi / 2) ? 1.0 : std::max(a, b)};
}

bool same_value(float a, float b, float limit) {
  return a == b || std::abs(a - b) <= limit || (std::isnan(a) && std::isnan(b));
}

bool same_color(vec4 a, vec4 b, vec4 limit) {
  for (int i = 0; i < 4; ++i)
    if (!same_value(a[i], b[i], limit[i])) return false;
  return true;
}

}  // namespace

std::uint64_t ulp_distance(float a, float b) {
  if (std::isnan(a) || std::isnan(b))
    return std::isnan(a) && std::isnan(b) ? 0 : std::numeric_limits<std::uint32_t>::max();
  const std::int64_t i = order_of<std::int32_t, std::uint32_t>(a);
  const std::int64_t k = order_of<std::int32_t, std::uint32_t>(b);
  return static_cast<std::uint64_t>(i > k ? i - k : k - i);
}

std::uint64_t ulp_distance(double a, double b) {
  if (std::isnan(a) || std::isnan(b))
    return std::isnan(a) && std::isnan(b) ? 0 : std::numeric_limits<std::uint64_t>::max();
  const auto i = static_cast<std::uint64_t>(order_of<std::int64_t, std::uint64_t>(a));
  const auto k = static_cast<std::uint64_t>(order_of<std::int64_t, std::uint64_t>(b));
  return a > b ? i - k : k - i;
}

Interval Interval::rounded(double value) { return settle(value, value); }

Interval Interval::between(double low, double high) { return {low, high}; }

Interval Interval::everything() { return {-infinity, infinity}; }

bool Interval::accepts_everything() const { return std::isinf(low_) || std::isinf(high_); }

bool Interval::contains(float value) const { return distance(value) == 0; }

double Interval::distance(float value) const {
  if (accepts_everything()) return 0;
  if (std::isnan(value)) return infinity;
  return std::max({0.0, low_ - value, value - high_});
}

Interval operator+(Interval a, Interval b) { return settle(a.low_ + b.low_, a.high_ + b.high_); }

Interval operator-(Interval a, Interval b) { return settle(a.low_ - b.high_, a.high_ - b.low_); }

Interval operator*(Interval a, Interval b) {
  const auto [low, high] =
      std::minmax({a.low_ * b.low_, a.low_ * b.high_, a.high_ * b.low_, a.high_ * b.high_});
  return settle(low, high);
}

Interval operator/(Interval a, Interval b) {
  const double least =
      b.low_ <= 0 && b.high_ >= 0 ? 0 : std::min(std::abs(b.low_), std::abs(b.high_));
  const double most = std::max(std::abs(b.low_), std::abs(b.high_));
  if (least < smallest_normal || most > 0x1p126) return Interval::everything();
  const auto [low, high] =
      std::minmax({a.low_ / b.low_, a.low_ / b.high_, a.high_ / b.low_, a.high_ / b.high_});
  return widen_ulps(low, high, 2.5);
}

Interval inverse_sqrt(Interval x) {
  if (x.accepts_everything() || x.low_ <= 0) return Interval::everything();
  return widen_ulps(1 / std::sqrt(x.high_), 1 / std::sqrt(x.low_), 2);
}

Interval sqrt(Interval x) {
  if (x.low_ == 0 && x.high_ == 0) return Interval(0.0f);
  return Interval(1.0f) / inverse_sqrt(x);
}

Interval exp2(Interval x) { return exp_bounds(x, std::exp2(x.low_), std::exp2(x.high_)); }

Interval exp(Interval x) { return exp_bounds(x, std::exp(x.low_), std::exp(x.high_)); }

Interval log2(Interval x) { return log_bounds(x, std::log2(x.low_), std::log2(x.high_)); }

Interval log(Interval x) { return log_bounds(x, std::log(x.low_), std::log(x.high_)); }

Interval pow(Interval x, Interval y) { return exp2(y * log2(x)); }

Interval sin(Interval x) {
  if (x.low_ < -std::numbers::pi || x.high_ > std::numbers::pi) return Interval::everything();
  const auto [low, high] = sine_range(x.low_, x.high_);
  return widen_absolute(low, high, 0x1p-11);
}

Interval cos(Interval x) {
  constexpr double quarter = std::numbers::pi / 2;
  if (x.low_ < -std::numbers::pi || x.high_ > std::numbers::pi) return Interval::everything();
  const auto [low, high] = sine_range(x.low_ + quarter, x.high_ + quarter);
  return widen_absolute(low, high, 0x1p-11);
}

Interval atan(Interval x) {
  if (x.accepts_everything()) return x;
  return widen_ulps(std::atan(x.low_), std::atan(x.high_), 4096);
}

Interval acos(Interval x) {
  if (x.low_ < -1 || x.high_ > 1) return Interval::everything();
  // atan2 falls with x and rises with y; both are known to intervals.
  const Interval y = sqrt(Interval(1.0f) - x * x);
  if (y.accepts_everything()) return y;
  const double low = std::min(std::atan2(y.low_, x.high_), std::atan2(y.high_, x.high_));
  const double high = std::max(std::atan2(y.low_, x.low_), std::atan2(y.high_, x.low_));
  return widen_ulps(low, high, 4096);
}

Interval min(Interval a, Interval b) {
  return Interval::between(std::min(a.low_, b.low_), std::min(a.high_, b.high_));
}

Interval max(Interval a, Interval b) {
  return Interval::between(std::max(a.low_, b.low_), std::max(a.high_, b.high_));
}

Interval abs(Interval x) {
  if (x.low_ >= 0) return x;
  if (x.high_ <= 0) return -x;
  return Interval::between(0, std::max(-x.low_, x.high_));
}

std::string PixelCensus::text() const {
  std::string text = std::to_string(wrong()) + " of " + std::to_string(pixels) +
                     " pixels: coverage " + std::to_string(coverage) + ", depth " +
                     std::to_string(depth) + ", colour " + std::to_string(color);
  if (!places.empty())
    text += "; first at (" + std::to_string(places[0].x) + ", " + std::to_string(places[0].y) + ")";
  return text;
}

PixelCensus take_census(const Picture& got, const Picture& want, const CensusLimits& limits) {
  const int width = want.color.width(), height = want.color.height();
  if (got.color.width() != width || got.color.height() != height)
    throw std::invalid_argument("take_census: " + std::to_string(got.color.width()) + "x" +
                                std::to_string(got.color.height()) + " against " +
                                std::to_string(width) + "x" + std::to_string(height));
  const bool elements =
      got.element.size() == got.color.size() && want.element.size() == want.color.size();
  const bool depths =
      got.depth.size() == got.color.size() && want.depth.size() == want.color.size();
  PixelCensus census{.pixels = want.color.size(), .places = {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const vec4 a = got.color(x, y), b = want.color(x, y);
      const bool other_cover =
          (a.w == 0) != (b.w == 0) || (elements && got.element(x, y) != want.element(x, y));
      if (other_cover)
        ++census.coverage;
      else if (depths && !same_value(got.depth(x, y), want.depth(x, y), limits.depth))
        ++census.depth;
      else if (!same_color(a, b, limits.color))
        ++census.color;
      else
        continue;
      if (census.places.size() < 16) census.places.push_back({x, y});
    }
  return census;
}

}  // namespace parity
