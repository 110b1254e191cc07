#include "cpu_reference/sampling/reconstruct.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace parity::cpu {
namespace {

constexpr double pi = std::numbers::pi;

double sinc(double x) { return std::abs(x) < 1e-9 ? 1.0 : std::sin(pi * x) / (pi * x); }

/// The cubic of Mitchell and Netravali for B and C.
double cubic(double x, double b, double c) {
  x = std::abs(x);
  if (x < 1)
    return ((12 - 9 * b - 6 * c) * x * x * x + (-18 + 12 * b + 6 * c) * x * x + (6 - 2 * b)) / 6;
  if (x < 2)
    return ((-b - 6 * c) * x * x * x + (6 * b + 30 * c) * x * x + (-12 * b - 48 * c) * x +
            (8 * b + 24 * c)) /
           6;
  return 0;
}

/// Its transform: a function whose second derivative jumps by d2 and third by d3 at its knots has
/// sum (d2 / (i w)^3 + d3 / (i w)^4) exp(-i w x), here of even functions.
double cubic_spectrum(double f, double b, double c) {
  const double w = 2 * pi * f;
  if (std::abs(w) < 0.05)  // the closed form cancels: two terms of the moments' series
    return 1 - 0.5 * (2 + 3 * b - 4 * c) / 15 * w * w;
  const auto second = [&](double x) {  // of the inner, of the outer cubic
    return std::pair{((12 - 9 * b - 6 * c) * 6 * x + (-18 + 12 * b + 6 * c) * 2) / 6,
                     ((-b - 6 * c) * 6 * x + (6 * b + 30 * c) * 2) / 6};
  };
  const double inner3 = 12 - 9 * b - 6 * c;
  const double outer3 = -b - 6 * c;
  const double jump2_at_1 = second(1).second - second(1).first;
  const double jump2_at_2 = -second(2).second;
  const double sines = jump2_at_1 * std::sin(w) + jump2_at_2 * std::sin(2 * w);
  const double cosines =
      2 * inner3 + 2 * (outer3 - inner3) * std::cos(w) - 2 * outer3 * std::cos(2 * w);
  return (cosines / w + 2 * sines) / (w * w * w);
}

/// Of x above 40: pi / 2 - f cos x - g sin x, with the asymptotic series of f and g up to the tenth
/// term, 20! / x^20 or 3e-14. Source: Abramowitz & Stegun 5.2.8, 5.2.34, 5.2.35.
double far_sine_integral(double x) {
  double f = 0, g = 0, term = 1 / x;
  for (int n = 0; n < 10; ++n) {
    f += term;
    g += term * (2 * n + 1) / x;
    term *= -(2 * n + 1) * (2 * n + 2) / (x * x);
  }
  return pi / 2 - f * std::cos(x) - g * std::sin(x);
}

/// The sine integral, by Simpson's rule on intervals of at most 1/8: 1e-9 off.
double sine_integral(double x) {
  if (std::abs(x) > 40) return std::copysign(far_sine_integral(std::abs(x)), x);
  const int steps = 2 * (int(std::abs(x) * 8) + 8);
  const double h = x / steps;
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const double t = i * h;
    const double value = t == 0 ? 1.0 : std::sin(t) / t;
    sum += value * (i == 0 || i == steps ? 1 : i % 2 == 1 ? 4 : 2);
  }
  return sum * h / 3;
}

/// Integral over [0, a] of (1 - cos(p x)) / x^2.
double cosine_loss(double p, double a) {
  p = std::abs(p);
  return p * sine_integral(p * a) - (1 - std::cos(p * a)) / a;
}

/// sinc(x) sinc(x / a) cos(w x) is a / (4 pi^2 x^2) times cosines of the sums and differences of pi
/// +- pi / a and w.
double lanczos_spectrum(double f, double a) {
  const double w = 2 * pi * f, low = pi - pi / a, high = pi + pi / a;
  return a / (2 * pi * pi) *
         (cosine_loss(high + w, a) + cosine_loss(high - w, a) - cosine_loss(low + w, a) -
          cosine_loss(low - w, a));
}

/// Texels of the source under the filter at pixel `to`, with weights that sum to 1.
struct Tap {
  int texel;
  double weight;
};

std::vector<Tap> taps_of(int to, int from_count, int to_count, ReconstructionFilter filter) {
  const double ratio = double(from_count) / to_count;
  const double width = std::max(ratio, 1.0);  // of a filter's px, in texels
  const double middle = (to + 0.5) * ratio;
  const double reach = filter_radius(filter) * width;
  std::vector<Tap> taps;
  double sum = 0;
  for (int j = int(std::floor(middle - reach)) - 1; j <= int(std::ceil(middle + reach)); ++j) {
    // (2 j + 1) to_count - (2 to + 1) from_count is exact: so are decisions at the border of a box.
    const double apart = (2.0 * j + 1) * to_count - (2.0 * to + 1) * from_count;
    const double x = apart / (2.0 * std::max(from_count, to_count));
    const double weight = filter_value(filter, x);
    if (weight == 0) continue;
    taps.push_back({std::min(std::max(j, 0), from_count - 1), weight});
    sum += weight;
  }
  for (Tap& tap : taps) tap.weight /= sum;
  return taps;
}

}  // namespace

double filter_value(ReconstructionFilter filter, double x) {
  const double distance = std::abs(x);
  if (distance > filter_radius(filter)) return 0;
  switch (filter) {
    case ReconstructionFilter::box:
      return distance == 0.5 ? 0.5 : 1.0;
    case ReconstructionFilter::tent:
      return 1 - distance;
    case ReconstructionFilter::gaussian:
      return std::sqrt(2 / pi) * std::exp(-2 * x * x);
    case ReconstructionFilter::mitchell:
      return cubic(x, 1.0 / 3, 1.0 / 3);
    case ReconstructionFilter::lanczos:
      return sinc(x) * sinc(x / 3);
  }
  return 0;
}

double filter_spectrum(ReconstructionFilter filter, double f) {
  switch (filter) {
    case ReconstructionFilter::box:
      return sinc(f);
    case ReconstructionFilter::tent:
      return sinc(f) * sinc(f);
    case ReconstructionFilter::gaussian:
      return std::exp(-0.5 * pi * pi * f * f);
    case ReconstructionFilter::mitchell:
      return cubic_spectrum(f, 1.0 / 3, 1.0 / 3);
    case ReconstructionFilter::lanczos:
      return lanczos_spectrum(f, 3);
  }
  return 0;
}

Grid<dvec4> reconstruct(const Grid<dvec4>& picture, ivec2 size, ReconstructionFilter filter) {
  if (picture.empty()) throw std::invalid_argument("cpu::reconstruct: the picture is empty");
  if (size.x < 1 || size.y < 1 || size.x > 16384 || size.y > 16384)
    throw std::invalid_argument("cpu::reconstruct: size is " + std::to_string(size.x) + "x" +
                                std::to_string(size.y) + ", sides must be 1 to 16384");
  std::vector<std::vector<Tap>> columns;
  for (int x = 0; x < size.x; ++x) columns.push_back(taps_of(x, picture.width(), size.x, filter));
  Grid<dvec4> result{size.x, size.y};
#pragma omp parallel for
  for (int y = 0; y < size.y; ++y) {
    const std::vector<Tap> rows = taps_of(y, picture.height(), size.y, filter);
    for (int x = 0; x < size.x; ++x)
      for (const Tap& row : rows)
        for (const Tap& column : columns[std::size_t(x)])
          result(x, y) += row.weight * column.weight * picture(column.texel, row.texel);
  }
  return result;
}

}  // namespace parity::cpu
