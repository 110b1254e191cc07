#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "geometry/environment.h"
#include "geometry/random.h"

/// Surroundings to be prefiltered, and how far light in them is apart.
namespace parity::shading_test {

/// A sky with some lamps: lobes of light over a gradient.
inline EnvironmentMap lamps(std::uint64_t seed, int side, float strength) {
  constexpr double pi = std::numbers::pi;
  Random random{seed};
  Grid<vec4> picture{128, 64};
  std::array<vec3, 5> directions;
  for (vec3& d : directions) d = random.direction();
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 128; ++x) {
      const double theta = pi * (y + 0.5) / 64, phi = 2 * pi * ((x + 0.5) / 128 - 0.5);
      const vec3 d{dvec3(std::sin(theta) * std::sin(phi), std::cos(theta),
                         -std::sin(theta) * std::cos(phi))};
      vec3 light{0.5f + 0.4f * d.y, 0.5f, 0.6f - 0.3f * d.x};
      for (const vec3& lamp : directions)
        light += strength * std::pow(std::max(0.0f, glm::dot(d, lamp)), 40.0f);
      picture(x, y) = vec4(light, 1);
    }
  return environment_map(picture, side);
}

/// Largest radiance and largest change from texel to texel.
inline dvec2 extremes(const Grid<vec4>& level) {
  dvec2 result{0.0};
  for (int y = 0; y < level.height(); ++y)
    for (int x = 0; x < level.width(); ++x)
      for (int c = 0; c < 3; ++c) {
        result.x = std::max(result.x, double(level(x, y)[c]));
        if (x + 1 < level.width())
          result.y = std::max(result.y, double(std::abs(level(x + 1, y)[c] - level(x, y)[c])));
      }
  return result;
}

/// Largest difference of any channel.
inline double largest_apart(const Grid<vec4>& got, const Grid<vec4>& want) {
  double worst = 0;
  for (std::size_t i = 0; i < want.size(); ++i)
    for (int c = 0; c < 3; ++c)
      worst = std::max(worst, double(std::abs(got.values()[i][c] - want.values()[i][c])));
  return worst;
}

}  // namespace parity::shading_test
