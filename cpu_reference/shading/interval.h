#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace parity::cpu {

/// All values that single precision on a right device may give for an expression: every operation
/// widens the interval by the bound that Vulkan sets on it. Evaluating a formula with Interval in
/// the place of double turns "operations x 2^-24 x magnitude" into an enclosure.
///
/// Source: Vulkan 1.3, "Precision of Individual Operations"; the method of VK-GL-CTS.
struct Interval {
  double low = 0;
  double high = 0;

  Interval() = default;
  Interval(double value) : low(value), high(value) {}
  Interval(double from, double to) : low(from), high(to) {}
};

namespace detail {

/// Numbers below the smallest normal float may be flushed to 0.
constexpr double flushed = 1.1754943508222875e-38;
/// An ulp of x is at most |x| 2^-23.
constexpr double ulp = 1.1920928955078125e-7;

inline Interval everything() {
  return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
}

/// Widens by a number of ulp of the exact value.
inline Interval widen(double low, double high, double ulps) {
  if (std::isnan(low) || std::isnan(high)) return everything();
  return {low - std::abs(low) * ulps * ulp - flushed, high + std::abs(high) * ulps * ulp + flushed};
}

/// 0 times infinity: one factor may be arbitrarily small, so nothing is known.
inline Interval of_four(double a, double b, double c, double d, double ulps) {
  return widen(std::min(std::min(a, b), std::min(c, d)), std::max(std::max(a, b), std::max(c, d)),
               std::isnan(a + b + c + d) ? std::numeric_limits<double>::quiet_NaN() : ulps);
}

}  // namespace detail

/// Round to nearest: half an ulp.
inline Interval operator+(Interval a, Interval b) {
  return detail::widen(a.low + b.low, a.high + b.high, 0.5);
}
inline Interval operator-(Interval a, Interval b) {
  return detail::widen(a.low - b.high, a.high - b.low, 0.5);
}
inline Interval operator-(Interval a) { return {-a.high, -a.low}; }
inline Interval operator*(Interval a, Interval b) {
  return detail::of_four(a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high, 0.5);
}
/// 2.5 ulp; everything if the divisor may be 0.
inline Interval operator/(Interval a, Interval b) {
  if (b.low <= 0 && b.high >= 0) return detail::everything();
  return detail::of_four(a.low / b.low, a.low / b.high, a.high / b.low, a.high / b.high, 2.5);
}

inline double square(double a) { return a * a; }
inline Interval square(Interval a) {
  const double low = std::abs(a.low), high = std::abs(a.high);
  const double least = a.low <= 0 && a.high >= 0 ? 0.0 : std::min(low, high);
  const double most = std::max(low, high);
  return detail::widen(least * least, most * most, 0.5);
}

/// 2 ulp.
inline double inverse_sqrt(double a) { return 1 / std::sqrt(a); }
inline Interval inverse_sqrt(Interval a) {
  if (a.high <= 0) return detail::everything();
  if (a.low <= 0) return {0, std::numeric_limits<double>::infinity()};
  return detail::widen(1 / std::sqrt(a.high), 1 / std::sqrt(a.low), 2);
}

/// Inherits from 1 / inversesqrt: 2 + 2.5 ulp.
inline double square_root(double a) { return std::sqrt(a); }
inline Interval square_root(Interval a) {
  const Interval wide =
      detail::widen(std::sqrt(std::max(0.0, a.low)), std::sqrt(std::max(0.0, a.high)), 4.5);
  return {std::max(0.0, wide.low), wide.high};
}

/// 3 + 2 |x| ulp.
inline double exp2_of(double a) { return std::exp2(a); }
inline Interval exp2_of(Interval a) {
  const double ulps = 3 + 2 * std::max(std::abs(a.low), std::abs(a.high));
  return detail::widen(std::exp2(a.low), std::exp2(a.high), ulps);
}

/// 3 ulp outside of [0.5, 2], 2^-21 inside.
inline double log2_of(double a) { return std::log2(a); }
inline Interval log2_of(Interval a) {
  if (a.low <= 0) return detail::everything();
  const Interval wide = detail::widen(std::log2(a.low), std::log2(a.high), 3);
  return {wide.low - 0x1p-21, wide.high + 0x1p-21};
}

/// x^5 for x in [0, 1], by products or by pow = exp2(5 log2 x).
inline double fifth_power(double a) { return square(square(a)) * a; }
inline Interval fifth_power(Interval a) {
  const Interval products = square(square(a)) * a;
  if (a.low <= 0) return {std::min(0.0, products.low), products.high * (1 + 0x1p-17)};
  const Interval power = exp2_of(Interval(5.0) * log2_of(a));
  return {std::min(products.low, power.low), std::max(products.high, power.high)};
}

inline double least(double a, double b) { return std::min(a, b); }
inline Interval least(Interval a, Interval b) {
  return {std::min(a.low, b.low), std::min(a.high, b.high)};
}
inline double most(double a, double b) { return std::max(a, b); }
inline Interval most(Interval a, Interval b) {
  return {std::max(a.low, b.low), std::max(a.high, b.high)};
}
inline double magnitude(double a) { return std::abs(a); }
inline Interval magnitude(Interval a) {
  if (a.low >= 0) return a;
  if (a.high <= 0) return -a;
  return {0, std::max(-a.low, a.high)};
}
template <class Real>
Real clamped(Real a, double low, double high) {
  return least(most(a, Real(low)), Real(high));
}

/// Certainly at most 0.
inline bool vanishes(double a) { return a <= 0; }
inline bool vanishes(Interval a) { return a.high <= 0; }

/// A number of the host, rounded once to single precision.
template <class Real>
Real rounded(double a);
template <>
inline double rounded<double>(double a) {
  return a;
}
template <>
inline Interval rounded<Interval>(double a) {
  return detail::widen(a, a, 0.5);
}

/// Farthest that a right device may be from `value`.
inline double deviation(Interval a, double value) {
  return std::max(a.high - value, value - a.low);
}

}  // namespace parity::cpu
