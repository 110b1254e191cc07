#include "cpu_reference/texture/sample.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "cpu_reference/texture/texel.h"

namespace parity::cpu {
namespace {

std::array<double, 256> srgb_table() {
  std::array<double, 256> table{};
  for (int code = 0; code < 256; ++code) {
    const double c = code / 255.0;
    table[std::size_t(code)] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  }
  return table;
}

std::array<double, 256> unorm_table() {
  std::array<double, 256> table{};
  for (int code = 0; code < 256; ++code) table[std::size_t(code)] = code / 255.0;
  return table;
}

const std::array<double, 256> linear_of_srgb = srgb_table();
const std::array<double, 256> linear_of_unorm = unorm_table();

dvec4 decode(u8vec4 texel, bool srgb) {
  const auto& table = srgb ? linear_of_srgb : linear_of_unorm;
  return {table[texel.x], table[texel.y], table[texel.z], linear_of_unorm[texel.w]};
}

/// Order-dependent mix, so that a choice at another place is another choice.
std::uint32_t mix_choice(std::uint32_t seed, std::uint32_t value) {
  return (seed ^ value) * 16777619u + 0x9e3779b9u;
}

TextureLookup nearest_texel(const MippedTexture& t, dvec2 uv, int level) {
  const Grid<u8vec4>& image = t.levels[std::size_t(level)];
  const auto x = std::int64_t(std::floor(bounded_coordinate(uv.x * image.width())));
  const auto y = std::int64_t(std::floor(bounded_coordinate(uv.y * image.height())));
  const int column = wrap_texel(x, image.width(), t.sampler.wrap_u).value_or(-1);
  const int row = wrap_texel(y, image.height(), t.sampler.wrap_v).value_or(-1);
  const std::uint32_t where =
      mix_choice(mix_choice(std::uint32_t(level), std::uint32_t(column)), std::uint32_t(row));
  return {read_texel(image, t.srgb, x, y, t.sampler), where};
}

TextureLookup bilinear(const MippedTexture& t, dvec2 uv, int level) {
  const Grid<u8vec4>& image = t.levels[std::size_t(level)];
  const double u = bounded_coordinate(uv.x * image.width() - 0.5);
  const double v = bounded_coordinate(uv.y * image.height() - 0.5);
  const double a = u - std::floor(u);
  const double b = v - std::floor(v);
  const auto texel = [&](int right, int down) {
    return read_texel(image, t.srgb, std::int64_t(std::floor(u)) + right,
                      std::int64_t(std::floor(v)) + down, t.sampler);
  };
  const dvec4 top = texel(0, 0) * (1 - a) + texel(1, 0) * a;
  const dvec4 bottom = texel(0, 1) * (1 - a) + texel(1, 1) * a;
  return {top * (1 - b) + bottom * b, 0};
}

TextureLookup filtered(const MippedTexture& t, Filter filter, dvec2 uv, int level) {
  return filter == Filter::nearest ? nearest_texel(t, uv, level) : bilinear(t, uv, level);
}

/// Two levels, mixed.
TextureLookup between_levels(const MippedTexture& t, dvec2 uv, double lambda) {
  const int last = int(t.levels.size()) - 1;
  const double d = std::min(lambda, double(last));
  const int fine = int(std::floor(d));
  const double weight = d - fine;
  const TextureLookup a = filtered(t, t.sampler.min, uv, fine);
  if (weight == 0) return a;
  const TextureLookup b = filtered(t, t.sampler.min, uv, std::min(fine + 1, last));
  const bool chose = t.sampler.min == Filter::nearest;
  return {a.value * (1 - weight) + b.value * weight, chose ? mix_choice(a.choices, b.choices) : 0};
}

/// A change of filter at lambda = 0 is a choice only where the two filters differ.
std::uint32_t filter_choice(const Sampler& s, bool minified) {
  return s.mag != s.min && minified ? 0x51ed27u : 0u;
}

}  // namespace

std::optional<int> wrap_texel(std::int64_t i, int size, Wrap wrap) {
  if (i >= 0 && i < size) return int(i);
  switch (wrap) {
    case Wrap::repeat: {
      const std::int64_t r = i % size;
      return int(r < 0 ? r + size : r);
    }
    case Wrap::mirrored_repeat: {
      const std::int64_t period = 2 * std::int64_t(size);
      const std::int64_t r = ((i % period) + period) % period;
      return int(r < size ? r : period - 1 - r);
    }
    case Wrap::clamp_to_edge:
      return i < 0 ? 0 : size - 1;
    case Wrap::clamp_to_border:
      return std::nullopt;
    case Wrap::mirror_clamp_to_edge:
      return int(std::min<std::int64_t>(i < 0 ? -(i + 1) : i, size - 1));
  }
  return 0;
}

dvec4 read_texel(const Grid<u8vec4>& image, bool srgb, std::int64_t x, std::int64_t y,
                 const Sampler& sampler) {
  const std::optional<int> column = wrap_texel(x, image.width(), sampler.wrap_u);
  const std::optional<int> row = wrap_texel(y, image.height(), sampler.wrap_v);
  return column && row ? decode(image(*column, *row), srgb) : dvec4(0.0);
}

double bounded_coordinate(double c) { return std::isfinite(c) ? std::clamp(c, -1e15, 1e15) : 0.0; }

double linear_from_srgb_code(std::uint8_t code) { return linear_of_srgb[code]; }

double level_of_detail(dvec2 uv_dx, dvec2 uv_dy, int width, int height) {
  const dvec2 size{double(width), double(height)};
  const dvec2 dx = uv_dx * size;
  const dvec2 dy = uv_dy * size;
  const double longer = std::max(glm::dot(dx, dx), glm::dot(dy, dy));
  if (std::isnan(longer)) return std::numeric_limits<double>::infinity();
  return 0.5 * std::log2(longer);
}

TextureLookup sample(const MippedTexture& t, dvec2 uv, double lambda) {
  const Sampler& s = t.sampler;
  if (!(lambda > 0)) return filtered(t, s.mag, uv, 0);
  TextureLookup found;
  if (!s.mip) {
    found = filtered(t, s.min, uv, 0);
  } else if (*s.mip == Filter::nearest) {
    const double last = double(t.levels.size()) - 1;
    const int level = int(std::clamp(std::ceil(std::min(lambda, last + 1) + 0.5) - 1, 0.0, last));
    found = filtered(t, s.min, uv, level);
    if (level > 0) found.choices = mix_choice(found.choices, std::uint32_t(level));
  } else {
    found = between_levels(t, uv, lambda);
  }
  found.choices ^= filter_choice(s, true);
  return found;
}

}  // namespace parity::cpu
