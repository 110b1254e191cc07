#include "geometry/sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace parity {
namespace {

/// Middle of a pixel, from the picture's middle.
dvec2 from_middle(int x, int y, int width, int height) {
  return {x + 0.5 - 0.5 * width, y + 0.5 - 0.5 * height};
}

}  // namespace

std::string name_of(ReconstructionFilter filter) {
  constexpr std::array<const char*, 5> names{"box", "tent", "gaussian", "mitchell", "lanczos"};
  return names[std::size_t(filter)];
}

std::string name_of(SamplePattern pattern) {
  constexpr std::array<const char*, 8> names{"regular", "random", "jittered", "multi_jittered",
                                             "halton",  "sobol",  "r2",       "blue_noise"};
  return names[std::size_t(pattern)];
}

uvec2 strata(unsigned count) {
  unsigned rows = 1;
  for (unsigned i = 1; i * i <= count; ++i)
    if (count % i == 0) rows = i;
  return {count / rows, rows};
}

Grid<double> grating(int width, int height, dvec2 frequency) {
  Grid<double> picture{width, height};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      picture(x, y) = 0.5 + 0.5 * std::cos(2 * std::numbers::pi *
                                           glm::dot(frequency, from_middle(x, y, width, height)));
  return picture;
}

Grid<double> zone_plate(int width, int height, double k) {
  Grid<double> picture{width, height};
  const double longer = std::max(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const dvec2 p = from_middle(x, y, width, height);
      picture(x, y) = 0.5 + 0.5 * std::cos(std::numbers::pi * k * glm::dot(p, p) / longer);
    }
  return picture;
}

Grid<double> wheel(int side, int spokes, double angle) {
  Grid<double> picture{side, side};
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const dvec2 p = from_middle(x, y, side, side);
      const double phi = std::atan2(-p.y, p.x);
      const bool inside = glm::length(p) < 0.5 * side;
      picture(x, y) = inside && std::cos(spokes * (phi - angle)) > 0 ? 1.0 : 0.0;
    }
  return picture;
}

double half_plane_area(dvec2 normal, double offset) {
  // Mirrored so that both components are positive; the volume of a simplex, less its corners
  // outside of the pixel.
  double a = normal.x;
  double b = normal.y;
  if (a < 0) offset -= a, a = -a;
  if (b < 0) offset -= b, b = -b;
  if (a < b) std::swap(a, b);
  if (!(a > 0)) throw std::invalid_argument("half_plane_area: the normal is 0");
  if (b < 1e-12 * a) return std::clamp(offset / a, 0.0, 1.0);
  const auto square = [](double x) { return x > 0 ? x * x : 0.0; };
  const double area =
      (square(offset) - square(offset - a) - square(offset - b) + square(offset - a - b)) /
      (2 * a * b);
  return std::clamp(area, 0.0, 1.0);
}

}  // namespace parity
