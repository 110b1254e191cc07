#include "sim/color_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace parity {
namespace {

struct Lch {
  double lightness, chroma, hue_degrees;
};

Lch color_at(ColorMapKind kind, double t) {
  const double bump = std::sin(std::numbers::pi * t);
  if (kind == ColorMapKind::water) return {0.36 + 0.61 * t, 0.15 - 0.12 * t, 258 - 45 * t};
  if (kind == ColorMapKind::sequential) return {0.24 + 0.70 * t, 0.11 + 0.05 * bump, 292 - 187 * t};
  const double away = 2 * t - 1;
  return {0.95 - 0.55 * std::abs(away), 0.20 * std::abs(away), away < 0 ? 258.0 : 30.0};
}

dvec3 lab_of(const Lch& c) {
  const double angle = c.hue_degrees * std::numbers::pi / 180;
  return {c.lightness, c.chroma * std::cos(angle), c.chroma * std::sin(angle)};
}

bool is_on_screen(const dvec3& rgb) {
  return std::min({rgb.x, rgb.y, rgb.z}) >= 0 && std::max({rgb.x, rgb.y, rgb.z}) <= 1;
}

/// The colour with the largest chroma up to its own that a screen has.
dvec3 fitted(Lch color) {
  if (const dvec3 rgb = linear_from_oklab(lab_of(color)); is_on_screen(rgb)) return rgb;
  double low = 0, high = color.chroma;
  for (int i = 0; i < 30; ++i) {
    color.chroma = 0.5 * (low + high);
    (is_on_screen(linear_from_oklab(lab_of(color))) ? low : high) = color.chroma;
  }
  color.chroma = low;
  return linear_from_oklab(lab_of(color));
}

}  // namespace

dvec3 linear_from_oklab(const dvec3& lab) {
  const double l = std::pow(lab.x + 0.3963377774 * lab.y + 0.2158037573 * lab.z, 3);
  const double m = std::pow(lab.x - 0.1055613458 * lab.y - 0.0638541728 * lab.z, 3);
  const double s = std::pow(lab.x - 0.0894841775 * lab.y - 1.2914855480 * lab.z, 3);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

dvec3 oklab_from_linear(const dvec3& rgb) {
  const double l = std::cbrt(0.4122214708 * rgb.x + 0.5363325363 * rgb.y + 0.0514459929 * rgb.z);
  const double m = std::cbrt(0.2119034982 * rgb.x + 0.6806995451 * rgb.y + 0.1073969566 * rgb.z);
  const double s = std::cbrt(0.0883024619 * rgb.x + 0.2817188376 * rgb.y + 0.6299787005 * rgb.z);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

std::vector<vec3> color_map(ColorMapKind kind, int count) {
  std::vector<vec3> colors;
  for (int i = 0; i < count; ++i)
    colors.push_back(vec3(fitted(color_at(kind, double(i) / (count - 1)))));
  return colors;
}

}  // namespace parity
