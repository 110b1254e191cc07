#include "geometry/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace parity {
namespace {

double sign(double v) { return v < 0 ? -1.0 : 1.0; }

/// Bilinear; columns wrap around, rows end.
dvec3 equirectangular(const Grid<vec4>& picture, const dvec3& d) {
  const double width = picture.width(), height = picture.height();
  const double u = 0.5 + std::atan2(d.x, -d.z) / (2 * std::numbers::pi);
  const double v = std::acos(std::clamp(d.y, -1.0, 1.0)) / std::numbers::pi;
  const double x = u * width - 0.5, y = std::clamp(v * height - 0.5, 0.0, height - 1);
  const double left = std::floor(x), top = std::min(std::floor(y), std::max(0.0, height - 2));
  dvec3 sum{0.0};
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      const int column = int(left + i + width) % int(width);
      const int row = std::min(int(top) + j, int(height) - 1);
      dvec3 texel{picture(column, row)};
      for (int c = 0; c < 3; ++c)
        if (!(texel[c] > 0) || !std::isfinite(texel[c])) texel[c] = 0;
      sum += texel * ((i == 0 ? left + 1 - x : x - left) * (j == 0 ? top + 1 - y : y - top));
    }
  return sum;
}

/// Solid angle of a piece of the square, over its area: 1 / |p|^3 for p on the octahedron.
double density(const dvec2& uv) {
  const dvec3 d = octahedral_direction(uv);
  const double length = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);  // of 1 / |p|
  return length * length * length;
}

Grid<vec4> largest_level(const Grid<vec4>& picture, int side) {
  const int parts = std::max(picture.width() / side, 2);  // two to three samples a pixel and axis
  Grid<vec4> level{side, side};
#pragma omp parallel for schedule(dynamic)
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      dvec3 sum{0.0};
      double weight = 0;
      for (int j = 0; j < parts; ++j)
        for (int i = 0; i < parts; ++i) {
          const dvec2 uv = (dvec2(x, y) + (dvec2(i, j) + 0.5) / double(parts)) / double(side);
          const double w = density(uv);
          sum += w * equirectangular(picture, octahedral_direction(uv));
          weight += w;
        }
      level(x, y) = vec4(vec3(sum / weight), 1);
    }
  return level;
}

Grid<vec4> halved(const Grid<vec4>& level) {
  const int side = level.width() / 2;
  Grid<vec4> half{side, side};
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      dvec4 sum{0.0};
      double weight = 0;
      for (int k = 0; k < 4; ++k) {
        const ivec2 at{2 * x + k % 2, 2 * y + k / 2};
        const double w = density((dvec2(at) + 0.5) / double(level.width()));
        sum += w * dvec4(level(at.x, at.y));
        weight += w;
      }
      half(x, y) = vec4(sum / weight);
    }
  return half;
}

/// A texel outside of the square by one, brought back: mirrored at the middle of the edge.
ivec2 across_edge(ivec2 at, int side) {
  for (int axis = 0; axis < 2; ++axis)
    if (at[axis] < 0 || at[axis] >= side) {
      at[axis] = std::clamp(at[axis], 0, side - 1);
      at[1 - axis] = side - 1 - at[1 - axis];
    }
  return at;
}

}  // namespace

dvec2 octahedral_uv(const dvec3& d) {
  const double sum = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
  dvec2 p{d.x / sum, d.y / sum};
  if (d.z < 0) p = {(1 - std::abs(p.y)) * sign(p.x), (1 - std::abs(p.x)) * sign(p.y)};
  return 0.5 * p + 0.5;
}

dvec3 octahedral_direction(const dvec2& uv) {
  dvec2 p = 2.0 * uv - 1.0;
  const double z = 1 - std::abs(p.x) - std::abs(p.y);
  if (z < 0) p = {(1 - std::abs(p.y)) * sign(p.x), (1 - std::abs(p.x)) * sign(p.y)};
  return glm::normalize(dvec3(p, z));
}

EnvironmentMap environment_map(const Grid<vec4>& picture, int side) {
  if (picture.empty()) throw std::invalid_argument("environment_map: the picture is empty");
  if (side < 8 || side > 1024 || (side & (side - 1)) != 0)
    throw std::invalid_argument("environment_map: side is " + std::to_string(side) +
                                ", must be a power of two from 8 to 1024");
  EnvironmentMap map;
  map.levels.push_back(largest_level(picture, side));
  while (map.levels.back().width() > 4) map.levels.push_back(halved(map.levels.back()));
  return map;
}

bool harmonics_suffice(const std::array<vec3, 9>& harmonics, const Grid<vec4>& irradiance) {
  dvec3 mean{0.0}, worst{0.0};
  for (int y = 0; y < irradiance.height(); ++y)
    for (int x = 0; x < irradiance.width(); ++x) {
      const dvec3 n = octahedral_direction((dvec2(x, y) + 0.5) / double(irradiance.width()));
      const double basis[9] = {1,
                               n.y,
                               n.z,
                               n.x,
                               n.x * n.y,
                               n.y * n.z,
                               3 * n.z * n.z - 1,
                               n.x * n.z,
                               n.x * n.x - n.y * n.y};
      dvec3 apart{-dvec3(irradiance(x, y))};
      for (std::size_t k = 0; k < 9; ++k) apart += dvec3(harmonics[k]) * basis[k];
      worst = glm::max(worst, glm::abs(apart));
      mean += dvec3(irradiance(x, y)) / double(irradiance.size());
    }
  return glm::all(glm::lessThanEqual(worst, 0.01 * mean));
}

Grid<vec4> with_border(const Grid<vec4>& level) {
  const int side = level.width();
  Grid<vec4> result{side + 2, side + 2};
  for (int y = -1; y <= side; ++y)
    for (int x = -1; x <= side; ++x) {
      const ivec2 at = across_edge({x, y}, side);
      result(x + 1, y + 1) = level(at.x, at.y);
    }
  return result;
}

vec3 radiance_toward(const EnvironmentMap& map, const dvec3& direction) {
  const Grid<vec4>& level = map.levels[0];
  const int side = level.width();
  const dvec2 at = octahedral_uv(direction) * double(side) - 0.5;
  const dvec2 low = glm::floor(at);
  dvec3 sum{0.0};
  for (int k = 0; k < 4; ++k) {
    const ivec2 texel = across_edge(ivec2(low) + ivec2(k % 2, k / 2), side);
    const double wx = k % 2 == 0 ? low.x + 1 - at.x : at.x - low.x;
    const double wy = k / 2 == 0 ? low.y + 1 - at.y : at.y - low.y;
    sum += dvec3(level(texel.x, texel.y)) * (wx * wy);
  }
  return vec3(sum);
}

}  // namespace parity
