#include "cpu_reference/shading/lookup.h"

#include <algorithm>
#include <cmath>

namespace parity::cpu {
namespace {

/// Four entries between nodes (i, j) and (i + 1, j + 1).
dvec4 bilinear(const Grid<vec4>& table, int i, int j, double u, double v) {
  const dvec4 top = glm::mix(dvec4(table(i, j)), dvec4(table(i + 1, j)), u);
  const dvec4 bottom = glm::mix(dvec4(table(i, j + 1)), dvec4(table(i + 1, j + 1)), u);
  return glm::mix(top, bottom, v);
}

/// NaN is in the first.
int cell(double x, int side) { return x > 0 ? int(std::min(x, side - 2.0)) : 0; }

std::array<double, 4> between(const Grid<vec4>& table, double x, double y) {
  const int i = cell(x, table.width()), j = cell(y, table.height());
  const dvec4 value = bilinear(table, i, j, x - i, y - j);
  return {value.x, value.y, value.z, value.w};
}

/// A bilinear function is largest and smallest at the corners of a box, cell by cell. Single
/// precision adds three mixtures of two products and a sum: 10 ulp of the largest entry.
std::array<Interval, 4> between(const Grid<vec4>& table, const Interval& x, const Interval& y) {
  const int side = table.width(), height = table.height();
  dvec4 low{INFINITY}, high{-INFINITY}, size{0.0};
  for (int j = cell(y.low, height); j <= cell(y.high, height); ++j)
    for (int i = cell(x.low, side); i <= cell(x.high, side); ++i)
      for (int k = 0; k < 4; ++k) {
        const double u = std::clamp((k % 2 ? x.high : x.low) - i, 0.0, 1.0);
        const double v = std::clamp((k / 2 ? y.high : y.low) - j, 0.0, 1.0);
        const dvec4 value = bilinear(table, i, j, u, v);
        low = glm::min(low, value);
        high = glm::max(high, value);
        size = glm::max(size, glm::abs(dvec4(table(i + k % 2, j + k / 2))));
      }
  std::array<Interval, 4> result;
  for (int c = 0; c < 4; ++c) {
    const double rounding = 10 * detail::ulp * size[c];
    result[std::size_t(c)] = {low[c] - rounding, high[c] + rounding};
  }
  return result;
}

/// Place of a direction in a level with a border.
dvec2 place(const dvec3& direction, const Grid<vec4>& level) {
  const dvec2 at = octahedral_uv(direction) * double(level.width() - 2) + 0.5;
  return glm::clamp(at, dvec2(0.0), dvec2(double(level.width() - 1)));
}

dvec3 texel_between(const Grid<vec4>& level, const dvec2& at) {
  const int i = cell(at.x, level.width()), j = cell(at.y, level.width());
  return dvec3(bilinear(level, i, j, at.x - i, at.y - j));
}

/// A value and how far it may be off.
struct Spread {
  dvec3 value{0.0};
  dvec3 bound{0.0};
};

/// Largest change from texel to texel within `reach` cells of a place, or of all texels from 0.
dvec3 steepness(const Grid<vec4>& level, const dvec2& at, double reach) {
  const int side = level.width();
  dvec3 steep{0.0};
  const int r = int(std::min(reach, 1e4)) + 1;
  const int i0 = std::max(0, int(at.x) - r), i1 = std::min(side - 2, int(at.x) + r);
  const int j0 = std::max(0, int(at.y) - r), j1 = std::min(side - 2, int(at.y) + r);
  for (int j = j0; j <= j1; ++j)
    for (int i = i0; i <= i1; ++i) {
      const dvec3 here{level(i, j)};
      steep = glm::max(steep, glm::abs(dvec3(level(i + 1, j)) - here));
      steep = glm::max(steep, glm::abs(dvec3(level(i, j + 1)) - here));
      steep = glm::max(steep, glm::abs(dvec3(level(i + 1, j + 1)) - dvec3(level(i, j + 1))));
      steep = glm::max(steep, glm::abs(dvec3(level(i + 1, j + 1)) - dvec3(level(i + 1, j))));
    }
  return steep;
}

/// A level in all directions of a box. Where each component of d is off by e, p = d / (|x| + |y| +
/// |z|) is off by 4 e / sum in each, 8 e / sum once folded; the rounding of p itself is 4 ulp. The
/// border goes on where the square ends, so the value changes by the steepness of the cells around.
Spread toward(const Grid<vec4>& level, const Triple<Interval>& d) {
  const dvec3 center{0.5 * (d.x.low + d.x.high), 0.5 * (d.y.low + d.y.high),
                     0.5 * (d.z.low + d.z.high)};
  const double error = std::max({d.x.high - center.x, d.y.high - center.y, d.z.high - center.z});
  const double sum = std::abs(center.x) + std::abs(center.y) + std::abs(center.z);
  const dvec2 at = place(center, level);
  const double moved = (8 * error / sum + 8 * detail::ulp) * 0.5 * (level.width() - 2);
  Spread s;
  s.value = texel_between(level, at);
  const double texels = std::isfinite(moved) ? moved : 1e4;
  s.bound = 2 * texels * steepness(level, at, texels);
  s.bound += 10 * detail::ulp * (glm::abs(s.value) + s.bound);
  return s;
}

Triple<double> mirrored_at(const EnvironmentLight& light, const Triple<double>& d, double level) {
  const int i = cell(level, int(light.mirrors.size()));
  const auto read = [&](int k) {
    const Grid<vec4>& grid = light.mirrors[std::size_t(k)];
    return texel_between(grid, place({d.x, d.y, d.z}, grid));
  };
  const dvec3 value = glm::mix(read(i), read(i + 1), level - i);
  return {value.x, value.y, value.z};
}

/// Linear between levels: largest and smallest at an end or at a level.
Triple<Interval> mirrored_at(const EnvironmentLight& light, const Triple<Interval>& d,
                             const Interval& level) {
  const int count = int(light.mirrors.size());
  dvec3 low{INFINITY}, high{-INFINITY};
  for (int i = cell(level.low, count); i <= cell(level.high, count); ++i) {
    const Spread a = toward(light.mirrors[std::size_t(i)], d);
    const Spread b = toward(light.mirrors[std::size_t(i) + 1], d);
    for (const double end : {level.low, level.high}) {
      const double t = std::clamp(end - i, 0.0, 1.0);
      const dvec3 value = glm::mix(a.value, b.value, t);
      const dvec3 bound =
          glm::mix(a.bound, b.bound, t) + 4 * detail::ulp * glm::max(a.value, b.value);
      low = glm::min(low, value - bound);
      high = glm::max(high, value + bound);
    }
  }
  return {{low.x, high.x}, {low.y, high.y}, {low.z, high.z}};
}

Triple<double> irradiance_at(const Grid<vec4>& map, const Triple<double>& n) {
  const dvec3 value = texel_between(map, place({n.x, n.y, n.z}, map));
  return {value.x, value.y, value.z};
}

Triple<Interval> irradiance_at(const Grid<vec4>& map, const Triple<Interval>& n) {
  const Spread s = toward(map, n);
  const auto channel = [&](int c) {
    return Interval{s.value[c] - s.bound[c], s.value[c] + s.bound[c]};
  };
  return {channel(0), channel(1), channel(2)};
}

}  // namespace

template <class Real>
Triple<Real> tabulated_albedo(const Grid<vec4>& table, const Real& cosine, const Real& roughness) {
  const Real y = clamped(roughness, 1.0 / 64, 1.0);
  const Real alpha = square(y);
  const Real c = clamped(cosine, 1e-6, 1.0);
  const Real last{double(table.width() - 1)};
  const Real x = square_root(c * (Real(1.0) + alpha) / (c + alpha)) * last;
  const auto entry = between(table, x, y * last);
  const Real offset = entry[0] * fifth_power(clamped(Real(1.0) - (c + entry[1]), 0.0, 1.0));
  return {entry[0] - offset, offset, Real(1.0) - square(entry[2])};
}

template <class Real>
Real tabulated_sheen(const Grid<vec4>& table, const Real& cosine, const Real& roughness) {
  const Real last{double(table.width() - 1)};
  return between(table, square_root(clamped(cosine, 0.0, 1.0)) * last,
                 clamped(roughness, 0.2, 1.0) * last)[3];
}

template <class Real>
Triple<Real> mirrored(const EnvironmentLight& light, const Triple<Real>& direction,
                      const Real& roughness) {
  const Real r = clamped(roughness, 0.0, 1.0);
  const Real smooth = (r - rounded<Real>(0.045)) / rounded<Real>(0.055);
  const Real rough = least(r * Real(10.0), r * Real(5.0) + Real(1.0));
  return mirrored_at(light, direction, most(least(smooth, rough), Real(0.0)));
}

template <class Real>
Triple<Real> irradiance_over_pi(const EnvironmentLight& light, const Triple<Real>& n) {
  if (!light.irradiance.empty()) return irradiance_at(light.irradiance, n);
  const auto term = [&](std::size_t i, const Real& basis) {
    return triple<Real>(dvec3(light.harmonics[i])) * basis;
  };
  const Triple<Real> sum = term(0, Real(1.0)) + term(1, n.y) + term(2, n.z) + term(3, n.x) +
                           term(4, n.x * n.y) + term(5, n.y * n.z) +
                           term(6, Real(3.0) * square(n.z) - Real(1.0)) + term(7, n.x * n.z) +
                           term(8, square(n.x) - square(n.y));
  return {most(sum.x, Real(0.0)), most(sum.y, Real(0.0)), most(sum.z, Real(0.0))};
}

template Triple<double> tabulated_albedo(const Grid<vec4>&, const double&, const double&);
template Triple<Interval> tabulated_albedo(const Grid<vec4>&, const Interval&, const Interval&);
template double tabulated_sheen(const Grid<vec4>&, const double&, const double&);
template Interval tabulated_sheen(const Grid<vec4>&, const Interval&, const Interval&);
template Triple<double> mirrored(const EnvironmentLight&, const Triple<double>&, const double&);
template Triple<Interval> mirrored(const EnvironmentLight&, const Triple<Interval>&,
                                   const Interval&);
template Triple<double> irradiance_over_pi(const EnvironmentLight&, const Triple<double>&);
template Triple<Interval> irradiance_over_pi(const EnvironmentLight&, const Triple<Interval>&);

}  // namespace parity::cpu
