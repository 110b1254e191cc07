#include "cpu_reference/shading/tone_map.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace parity::cpu {
namespace {

using Rows = std::array<dvec3, 3>;

dvec3 times(const Rows& m, const dvec3& v) {
  return {glm::dot(m[0], v), glm::dot(m[1], v), glm::dot(m[2], v)};
}

dvec3 neutral(dvec3 c) {
  constexpr double reflected = 0.04, start = 0.8 - reflected, desaturation = 0.15;
  const double x = std::min({c.x, c.y, c.z});
  c -= x < 2 * reflected ? x - x * x / (4 * reflected) : reflected;
  const double peak = std::max({c.x, c.y, c.z});
  if (peak < start) return c;
  const double d = 1 - start;
  const double new_peak = 1 - d * d / (peak + d - start);
  const double keep = 1 / (desaturation * (peak - new_peak) + 1);
  return c * (new_peak / peak) * keep + dvec3(new_peak * (1 - keep));
}

dvec3 aces(const dvec3& c) {
  const Rows into{dvec3(0.59719, 0.35458, 0.04823), dvec3(0.07600, 0.90834, 0.01566),
                  dvec3(0.02840, 0.13383, 0.83777)};
  const Rows back{dvec3(1.60475, -0.53108, -0.07367), dvec3(-0.10208, 1.10813, -0.00605),
                  dvec3(-0.00327, -0.07276, 1.07602)};
  dvec3 v = times(into, c);
  for (int i = 0; i < 3; ++i) {
    const double up = v[i] * v[i] + 0.0245786 * v[i] - 0.000090537;
    v[i] = up / (0.983729 * v[i] * v[i] + 0.4329510 * v[i] + 0.238081);
  }
  return times(back, v);
}

dvec3 agx(const dvec3& c) {
  const Rows into{dvec3(0.842479062253094, 0.0784335999999992, 0.0792237451477643),
                  dvec3(0.0423282422610123, 0.878468636469772, 0.0791661274605434),
                  dvec3(0.0423756549057051, 0.0784336, 0.879142973793104)};
  const Rows back{dvec3(1.19687900512017, -0.0980208811401368, -0.0990297440797205),
                  dvec3(-0.0528968517574562, 1.15190312990417, -0.0989611768448433),
                  dvec3(-0.0529716355144438, -0.0980434501171241, 1.15107367264116)};
  constexpr double least = -12.47393, most = 4.026069;
  dvec3 v = times(into, c);
  for (int i = 0; i < 3; ++i) {
    const double x =
        (std::clamp(std::log2(std::max(v[i], 1e-10)), least, most) - least) / (most - least);
    v[i] = 15.5 * std::pow(x, 6) - 40.14 * std::pow(x, 5) + 31.96 * std::pow(x, 4) -
           6.868 * std::pow(x, 3) + 0.4298 * x * x + 0.1191 * x - 0.00232;
  }
  v = times(back, v);
  for (int i = 0; i < 3; ++i) v[i] = std::pow(std::max(0.0, v[i]), 2.2);
  return v;
}

}  // namespace

dvec3 tone_map(const dvec3& light, ToneMap tone_map) {
  dvec3 c;
  for (int i = 0; i < 3; ++i) c[i] = light[i] > 0 ? std::min(light[i], 1e8) : 0.0;
  if (tone_map == ToneMap::neutral) c = neutral(c);
  if (tone_map == ToneMap::aces) c = aces(c);
  if (tone_map == ToneMap::agx) c = agx(c);
  return glm::clamp(c, dvec3(0.0), dvec3(1.0));
}

Grid<vec4> tone_map(const Grid<vec4>& colors, ToneMap operation, float exposure) {
  Grid<vec4> mapped{colors.width(), colors.height()};
  const double gain = std::exp2(double(exposure));
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const vec4& c = colors.values()[i];
    mapped.values()[i] = vec4(dvec4(tone_map(dvec3(c) * gain, operation), double(c.w)));
  }
  return mapped;
}

}  // namespace parity::cpu
