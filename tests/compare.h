#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "geometry/frame.h"
#include "tests/numbers.h"

/// How answers are compared: in units of the last place, by acceptance intervals, pixel by pixel.
namespace parity {

/// Floats from `a` to `b`, counted; 0 and -0 are one. NaN is 2^32 - 1 away from all but NaN.
std::uint64_t ulp_distance(float a, float b);
/// The same for doubles; NaN is 2^64 - 1 away.
std::uint64_t ulp_distance(double a, double b);

/// Largest |got - want| over all numbers of two answers of any type; infinity where the counts
/// differ or NaN or infinity stands on one side only.
template <typename A, typename B>
double largest_difference(const A& got, const B& want) {
  const std::vector<double> g = numbers_of(got), w = numbers_of(want);
  if (g.size() != w.size()) return std::numeric_limits<double>::infinity();
  double largest = 0;
  for (std::size_t i = 0; i < g.size(); ++i) {
    if (g[i] == w[i] || (std::isnan(g[i]) && std::isnan(w[i]))) continue;
    const double difference = std::abs(g[i] - w[i]);
    if (!std::isfinite(difference)) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, difference);
  }
  return largest;
}

/// How many numbers differ at all; infinity where the counts do.
template <typename A, typename B>
double count_differences(const A& got, const B& want) {
  const std::vector<double> g = numbers_of(got), w = numbers_of(want);
  if (g.size() != w.size()) return std::numeric_limits<double>::infinity();
  double count = 0;
  for (std::size_t i = 0; i < g.size(); ++i)
    if (g[i] != w[i] && !(std::isnan(g[i]) && std::isnan(w[i]))) ++count;
  return count;
}

/// All values that a device may give for a 32-bit expression by the Vulkan specification: the
/// formula is evaluated with Intervals in double, each operation widened by its bound. Where the
/// specification promises nothing (overflow, a function outside its domain) everything is accepted.
///
/// Source: Vulkan 1.3, "Precision and Operation of SPIR-V Instructions"; ULP as Harrison defines
/// it.
class Interval {
 public:
  /// A float that is exactly known.
  Interval(float value) : low_(value), high_(value) {}
  /// All floats that may stand for a real number: its neighbours.
  static Interval rounded(double value);
  /// [low, high] as it is.
  static Interval between(double low, double high);
  static Interval everything();

  double low() const { return low_; }
  double high() const { return high_; }
  /// NaN only if everything is accepted.
  bool contains(float value) const;
  bool accepts_everything() const;
  /// 0 inside; the distance to the nearer end outside; infinity for NaN.
  double distance(float value) const;

  friend Interval operator+(Interval a, Interval b);
  friend Interval operator-(Interval a, Interval b);
  friend Interval operator*(Interval a, Interval b);
  friend Interval operator/(Interval a, Interval b);  ///< 2.5 ULP
  friend Interval operator-(Interval a) { return between(-a.high_, -a.low_); }

  friend Interval inverse_sqrt(Interval x);  ///< 2 ULP
  friend Interval sqrt(Interval x);          ///< 1 / inverse_sqrt(x)
  friend Interval exp2(Interval x);          ///< 3 + 2|x| ULP
  friend Interval exp(Interval x);           ///< 3 + 2|x| ULP
  friend Interval log2(Interval x);          ///< 3 ULP, 2^-21 absolute in [1/2, 2]
  friend Interval log(Interval x);
  friend Interval pow(Interval x, Interval y);  ///< exp2(y log2(x))
  friend Interval sin(Interval x);              ///< 2^-11 absolute in [-pi, pi]
  friend Interval cos(Interval x);
  friend Interval atan(Interval x);  ///< 4096 ULP
  friend Interval acos(Interval x);  ///< atan2(sqrt(1 - x x), x)
  friend Interval min(Interval a, Interval b);
  friend Interval max(Interval a, Interval b);
  friend Interval abs(Interval x);

 private:
  Interval(double low, double high) : low_(low), high_(high) {}
  double low_;
  double high_;
};

/// What may differ between two pictures of one scene.
struct CensusLimits {
  float depth = 0;
  vec4 color{0.0f};
};

/// Wrong pixels by cause. A pixel counts once: coverage (another triangle, or background on one
/// side only) before depth before colour.
struct PixelCensus {
  std::size_t pixels = 0;
  std::size_t coverage = 0;
  std::size_t depth = 0;
  std::size_t color = 0;
  std::vector<ivec2> places;  ///< of the first 16 wrong pixels
  std::size_t wrong() const { return coverage + depth + color; }
  /// "2 of 4096 pixels: coverage 1, depth 0, colour 1; first at (3, 7)"
  std::string text() const;
};

/// Elements are compared if both pictures have them, depths likewise. NaN is wrong unless both have
/// it.
///
/// @throws std::invalid_argument  the sizes differ.
PixelCensus take_census(const Picture& got, const Picture& want, const CensusLimits& limits);

}  // namespace parity
