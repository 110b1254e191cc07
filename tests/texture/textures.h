#pragma once

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "geometry/random.h"
#include "geometry/texture.h"
#include "shaders/texture/layout.h"
#include "tests/numbers.h"

/// Textures and places to read them at, for the stages of this chapter.
namespace parity {

inline auto fields_of(const TextureFootprint*) {
  return std::tuple{&TextureFootprint::uv, &TextureFootprint::uv_dx, &TextureFootprint::uv_dy};
}

namespace texture_test {

/// Every texel is independent of its neighbours, so that a wrong one is seen.
inline Grid<u8vec4> random_image(int width, int height, Random& random) {
  Grid<u8vec4> image{width, height};
  for (u8vec4& texel : image) {
    const std::uint32_t bits = random.next();
    texel = u8vec4(bits, bits >> 8, bits >> 16, bits >> 24);
  }
  return image;
}

/// Level k is of code `step` k everywhere: a lookup says its level of detail.
inline std::vector<Grid<u8vec4>> level_steps(int side, int step) {
  std::vector<Grid<u8vec4>> levels;
  for (int k = 0; side >> k > 0; ++k)
    levels.emplace_back(side >> k, side >> k, u8vec4(u8vec4::value_type(step * k)));
  return levels;
}

/// Footprints of all sizes, ratios and directions, in and around the texture; every fourth stands
/// on a border between texels or on the centre of one, where choices are made.
inline std::vector<TextureFootprint> random_footprints(int width, int height, int count,
                                                       Random& random) {
  const vec2 size{float(width), float(height)};
  std::vector<TextureFootprint> footprints;
  for (int i = 0; i < count; ++i) {
    TextureFootprint f;
    f.uv = {random.uniform(-2.0f, 3.0f), random.uniform(-2.0f, 3.0f)};
    if (i % 4 == 0) f.uv = glm::floor(f.uv * size * 2.0f) * 0.5f / size;
    const float across = std::exp2(random.uniform(-3.0f, 9.0f));
    const float down = across * std::exp2(random.uniform(-4.0f, 0.0f));
    const float turn = random.uniform(0.0f, 6.2831853f);
    const float skew = turn + random.uniform(0.5f, 2.6f);
    f.uv_dx = across * vec2(std::cos(turn), std::sin(turn)) / size;
    f.uv_dy = down * vec2(std::cos(skew), std::sin(skew)) / size;
    if (i % 2 == 1) std::swap(f.uv_dx, f.uv_dy);
    footprints.push_back(f);
  }
  return footprints;
}

}  // namespace texture_test
}  // namespace parity
