#include "cpu_reference/shading/prefilter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cpu_reference/shading/brdf.h"

namespace parity::cpu {
namespace {

using std::numbers::pi;

dvec3 read(const Grid<vec4>& bordered, const dvec3& direction) {
  const int side = bordered.width() - 2;
  const dvec2 at =
      glm::clamp(octahedral_uv(direction) * double(side) + 0.5, dvec2(0.0), dvec2(side + 1.0));
  const int i = std::min(int(at.x), side), j = std::min(int(at.y), side);
  const double u = at.x - i, v = at.y - j;
  return dvec3(bordered(i, j)) * ((1 - u) * (1 - v)) + dvec3(bordered(i + 1, j)) * (u * (1 - v)) +
         dvec3(bordered(i, j + 1)) * ((1 - u) * v) + dvec3(bordered(i + 1, j + 1)) * (u * v);
}

dvec3 read(const std::vector<Grid<vec4>>& levels, double level, const dvec3& direction) {
  const std::size_t i = std::min(std::size_t(level), levels.size() - 2);
  return glm::mix(read(levels[i], direction), read(levels[i + 1], direction), level - double(i));
}

std::vector<Grid<vec4>> bordered(const EnvironmentMap& map) {
  std::vector<Grid<vec4>> levels;
  for (const Grid<vec4>& level : map.levels) levels.push_back(with_border(level));
  return levels;
}

/// Van der Corput's sequence.
double radical_inverse(unsigned i) {
  double value = 0;
  for (double digit = 0.5; i > 0; i /= 2, digit /= 2) value += digit * (i % 2);
  return value;
}

dvec3 mirrored_light(const std::vector<Grid<vec4>>& levels, double roughness, const dvec3& n,
                     int samples) {
  if (roughness == 0) return read(levels[0], n);
  const double alpha = roughness * roughness;
  const dvec3 helper = std::abs(n.x) < 0.55 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
  const dvec3 t = glm::normalize(glm::cross(helper, n)), b = glm::cross(n, t);
  const double texels = std::pow(levels[0].width() - 2, 2);
  dvec3 sum{0.0};
  double weights = 0;
  for (int i = 0; i < samples; ++i) {
    const double u = (i + 0.5) / samples, phi = 2 * pi * radical_inverse(unsigned(i));
    const double tangent = alpha * std::sqrt(u / (1 - u));
    const double cosine = 1 / std::sqrt(1 + tangent * tangent);
    const dvec3 local{tangent * cosine * std::cos(phi), tangent * cosine * std::sin(phi), cosine};
    const double n_l = 2 * cosine * cosine - 1;
    if (!(n_l > 0)) continue;
    // The density of light is D / 4; a texel has 4 pi / texels.
    const double share = 4 / (ggx_density(local, dvec2(alpha)) * samples);
    const double level =
        std::clamp(std::log2(share * texels / (4 * pi)) / 2 + 1, 0.0, double(levels.size()) - 1);
    const dvec3 h = t * local.x + b * local.y + n * local.z;
    sum += n_l * read(levels, level, 2 * cosine * h - n);
    weights += n_l;
  }
  return sum / weights;
}

Grid<vec4> mirror_of(const std::vector<Grid<vec4>>& levels, double roughness, int side,
                     int samples) {
  Grid<vec4> mirror{side, side};
#pragma omp parallel for schedule(dynamic)
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const dvec3 n = octahedral_direction((dvec2(x, y) + 0.5) / double(side));
      mirror(x, y) = vec4(vec3(mirrored_light(levels, roughness, n, samples)), 1);
    }
  return mirror;
}

double solid_angle(const dvec3& d, int side) {
  return 4 * std::pow(std::abs(d.x) + std::abs(d.y) + std::abs(d.z), 3) / (double(side) * side);
}

/// The harmonics of degree 0 to 2 without their factors.
std::array<double, 9> basis_at(const dvec3& d) {
  return {
      1, d.y, d.z, d.x, d.x * d.y, d.y * d.z, 3 * d.z * d.z - 1, d.x * d.z, d.x * d.x - d.y * d.y};
}

std::array<vec3, 9> harmonics(const Grid<vec4>& level) {
  const int side = level.width();
  std::array<dvec3, 9> sums{};
  double sphere = 0;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const dvec3 d = octahedral_direction((dvec2(x, y) + 0.5) / double(side));
      const double w = solid_angle(d, side);
      sphere += w;
      const dvec3 light = dvec3(level(x, y)) * w;
      const std::array<double, 9> basis = basis_at(d);
      for (std::size_t k = 0; k < 9; ++k) sums[k] += light * basis[k];
    }
  // Squares of the harmonics' factors, times what the cosine lobe keeps: 1, 2/3, 1/4.
  constexpr double zero = 1 / (4 * pi), one = 2.0 / 3 * 3 / (4 * pi), two = 15 / (16 * pi);
  constexpr double factors[9] = {zero, one, one, one, two, two, 5 / (64 * pi), two, 15 / (64 * pi)};
  std::array<vec3, 9> result;
  for (std::size_t k = 0; k < 9; ++k) result[k] = vec3(sums[k] * (factors[k] * 4 * pi / sphere));
  return result;
}

/// A texel as a lamp: its direction times its solid angle, and its light.
struct Lamp {
  dvec3 weighed{0.0};
  dvec3 light{0.0};
};

std::vector<Lamp> lamps_of(const Grid<vec4>& level) {
  std::vector<Lamp> lamps;
  for (int y = 0; y < level.height(); ++y)
    for (int x = 0; x < level.width(); ++x) {
      const dvec3 d = octahedral_direction((dvec2(x, y) + 0.5) / double(level.width()));
      lamps.push_back({d * solid_angle(d, level.width()), dvec3(level(x, y))});
    }
  return lamps;
}

vec4 mean_over_hemisphere(const std::vector<Lamp>& lamps, const dvec3& n) {
  dvec3 sum{0.0};
  double weights = 0;
  for (const Lamp& lamp : lamps) {
    const double weight = std::max(glm::dot(lamp.weighed, n), 0.0);
    sum += weight * lamp.light;
    weights += weight;
  }
  return vec4(vec3(sum / weights), 1);
}

}  // namespace

Grid<vec4> prefilter_mirror(const EnvironmentMap& map, double roughness, int side, int samples) {
  return mirror_of(bordered(map), roughness, side, samples);
}

Grid<vec4> prefilter_irradiance(const EnvironmentMap& map) {
  std::size_t level = 0;
  while (map.levels[level].width() > irradiance_source_side) ++level;
  const std::vector<Lamp> lamps = lamps_of(map.levels[level]);
  Grid<vec4> result{irradiance_side, irradiance_side};
#pragma omp parallel for schedule(dynamic)
  for (int y = 0; y < irradiance_side; ++y)
    for (int x = 0; x < irradiance_side; ++x) {
      const dvec2 middle = (dvec2(x, y) + 0.5) / double(irradiance_side);
      result(x, y) = mean_over_hemisphere(lamps, octahedral_direction(middle));
    }
  return result;
}

std::array<vec3, 9> project_irradiance(const EnvironmentMap& map) {
  std::size_t small = 0;
  while (map.levels[small].width() > 64) ++small;
  return harmonics(map.levels[small]);
}

EnvironmentLight prefilter(const EnvironmentMap& map, int samples) {
  const std::vector<Grid<vec4>> levels = bordered(map);
  EnvironmentLight light;
  light.harmonics = project_irradiance(map);
  const Grid<vec4> irradiance = prefilter_irradiance(map);
  if (!harmonics_suffice(light.harmonics, irradiance)) light.irradiance = with_border(irradiance);
  for (std::size_t i = 0; i < mirror_sides.size(); ++i) {
    light.mirrors.push_back(
        with_border(mirror_of(levels, mirror_roughness[i], mirror_sides[i], samples)));
  }
  return light;
}

dvec3 mirror_by_quadrature(const Grid<vec4>& level, double roughness, const dvec3& n) {
  const int side = level.width();
  const double alpha2 = std::pow(roughness, 4);
  dvec3 sum{0.0};
  double weights = 0;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const dvec3 l = octahedral_direction((dvec2(x, y) + 0.5) / double(side));
      const double n_l = glm::dot(n, l);
      if (!(n_l > 0)) continue;
      const double cosine2 = (1 + n_l) / 2;  // of the half vector
      const double w =
          n_l * alpha2 / std::pow(1 - cosine2 * (1 - alpha2), 2) * solid_angle(l, side);
      sum += w * dvec3(level(x, y));
      weights += w;
    }
  return sum / weights;
}

}  // namespace parity::cpu
