#include "cpu_reference/shading/behind.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace parity::cpu {
namespace {

/// The texel on the left of (above) a place, such that there is another one unless the side is 1.
int texel_before(double at, int side) { return std::clamp(int(at), 0, std::max(side - 2, 0)); }

dvec4 between(const Grid<vec4>& level, const dvec2& at) {
  const int i = texel_before(at.x, level.width()), j = texel_before(at.y, level.height());
  const int right = std::min(i + 1, level.width() - 1), below = std::min(j + 1, level.height() - 1);
  const double u = at.x - i, v = at.y - j;
  return (1 - v) * ((1 - u) * dvec4(level(i, j)) + u * dvec4(level(right, j))) +
         v * ((1 - u) * dvec4(level(i, below)) + u * dvec4(level(right, below)));
}

/// A place from 0 to 1 as one from middle to middle of the texels at the sides.
dvec2 in_texels(const Grid<vec4>& level, const dvec2& place) {
  const dvec2 size{double(level.width()), double(level.height())};
  return glm::clamp(place * size - 0.5, dvec2(0.0), size - 1.0);
}

/// Largest change from texel to texel within `reach` texels of a place.
dvec4 steepness(const Grid<vec4>& level, const dvec2& at, double reach) {
  const int r = int(std::min(reach, 1e5)) + 1;
  const int right = std::min(level.width() - 1, int(at.x) + r + 1);
  const int bottom = std::min(level.height() - 1, int(at.y) + r + 1);
  dvec4 steep{0.0};
  for (int j = std::max(0, int(at.y) - r); j <= bottom; ++j)
    for (int i = std::max(0, int(at.x) - r); i <= right; ++i) {
      const dvec4 here{level(i, j)};
      if (i < right) steep = glm::max(steep, glm::abs(dvec4(level(i + 1, j)) - here));
      if (j < bottom) steep = glm::max(steep, glm::abs(dvec4(level(i, j + 1)) - here));
    }
  return steep;
}

std::array<double, 4> as_array(const dvec4& v) { return {v.x, v.y, v.z, v.w}; }

std::array<double, 4> read(const BehindPicture& picture, double x, double y, double roughness) {
  const double last = double(picture.levels.size() - 1);
  const double level = last * std::clamp((roughness - 0.045) / 0.955, 0.0, 1.0);
  const Grid<vec4>& finer = picture.levels[std::size_t(level)];
  const Grid<vec4>& coarser = picture.levels[std::size_t(std::ceil(level))];
  const dvec4 a = between(finer, in_texels(finer, {x, y}));
  const dvec4 b = between(coarser, in_texels(coarser, {x, y}));
  return as_array(glm::mix(a, b, level - std::floor(level)));
}

/// Linear between levels: largest and smallest at an end of the interval or at a level. A place is
/// off by its error and by the rounding of place times size; single precision adds three mixtures,
/// of two products and a sum each, to every level.
std::array<Interval, 4> read(const BehindPicture& picture, const Interval& x, const Interval& y,
                             const Interval& roughness) {
  const int last = int(picture.levels.size()) - 1;
  const Interval level =
      clamped((roughness - rounded<Interval>(0.045)) / rounded<Interval>(0.955), 0.0, 1.0) *
      Interval(double(last));
  const dvec2 place{0.5 * (x.low + x.high), 0.5 * (y.low + y.high)};
  const double error = std::max(x.high - x.low, y.high - y.low) / 2;
  dvec4 low{INFINITY}, high{-INFINITY};
  const auto spread = [&](int k, dvec4& value, dvec4& bound) {
    const Grid<vec4>& grid = picture.levels[std::size_t(k)];
    const double side = std::max(grid.width(), grid.height());
    const dvec2 at = in_texels(grid, place);
    const double moved =
        error * side + detail::ulp * side * (2 + std::abs(place.x) + std::abs(place.y));
    value = between(grid, at);
    bound = 2 * moved * steepness(grid, at, moved);
    bound += 10 * detail::ulp * (glm::abs(value) + bound);
  };
  const double top = std::clamp(level.high, 0.0, double(last));
  for (int k = int(std::clamp(level.low, 0.0, double(last))); k <= int(top); ++k) {
    dvec4 a, b, bound_a, bound_b;
    spread(k, a, bound_a);
    spread(std::min(k + 1, last), b, bound_b);
    for (const double end : {level.low, level.high}) {
      const double t = std::clamp(end - k, 0.0, 1.0);
      const dvec4 value = glm::mix(a, b, t);
      const dvec4 bound =
          glm::mix(bound_a, bound_b, t) + 4 * detail::ulp * glm::max(glm::abs(a), glm::abs(b));
      low = glm::min(low, value - bound);
      high = glm::max(high, value + bound);
    }
  }
  return {Interval{low.x, high.x}, Interval{low.y, high.y}, Interval{low.z, high.z},
          Interval{low.w, high.w}};
}

bool is_before_eye(double w) { return w > 0; }
bool is_before_eye(const Interval& w) { return w.high > 0; }

}  // namespace

template <class Real>
std::array<Real, 4> picture_behind(const BehindPicture& picture, const dvec3& origin,
                                   const Triple<Real>& position, const Real& roughness) {
  dmat4 world_from_position(1.0);
  world_from_position[3] = dvec4(origin, 1);
  const dmat4 m = picture.clip_from_world * world_from_position;
  const auto row = [&](int i) {
    return rounded<Real>(m[0][i]) * position.x + rounded<Real>(m[1][i]) * position.y +
           rounded<Real>(m[2][i]) * position.z + rounded<Real>(m[3][i]);
  };
  const Real w = row(3);
  if constexpr (std::is_same_v<Real, Interval>)
    if (w.low <= 0 && w.high > 0) {
      const Interval any = detail::everything();
      return {any, any, any, any};
    }
  if (!is_before_eye(w)) return read(picture, Real(0.5), Real(0.5), roughness);
  const Real half(0.5);
  return read(picture, row(0) / w * half + half, row(1) / w * half + half, roughness);
}

template std::array<double, 4> picture_behind(const BehindPicture&, const dvec3&,
                                              const Triple<double>&, const double&);
template std::array<Interval, 4> picture_behind(const BehindPicture&, const dvec3&,
                                                const Triple<Interval>&, const Interval&);

}  // namespace parity::cpu
