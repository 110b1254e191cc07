#include "cpu_reference/texture/anisotropic.h"

#include <algorithm>
#include <cmath>

#include "cpu_reference/texture/texel.h"

namespace parity::cpu {
namespace {

dvec2 size_of(const Grid<u8vec4>& image) { return {double(image.width()), double(image.height())}; }

/// Calls visit(x, y, r^2) for each texel inside an ellipse around uv, r of its radius.
template <typename Visit>
void visit_ellipse(const Grid<u8vec4>& image, dvec2 uv, const FootprintAxes& axes,
                   const Visit& visit) {
  const dvec2 middle = uv * size_of(image) - 0.5;
  const dvec2 across{-axes.direction.y, axes.direction.x};
  const dvec2 major = axes.direction * axes.major, minor = across * axes.minor;
  const dvec2 reach{std::hypot(major.x, minor.x), std::hypot(major.y, minor.y)};
  for (double y = std::ceil(middle.y - reach.y); y <= middle.y + reach.y; ++y)
    for (double x = std::ceil(middle.x - reach.x); x <= middle.x + reach.x; ++x) {
      const dvec2 d = dvec2(x, y) - middle;
      const double radius = std::pow(glm::dot(d, axes.direction) / axes.major, 2) +
                            std::pow(glm::dot(d, across) / axes.minor, 2);
      if (radius < 1) visit(std::int64_t(x), std::int64_t(y), radius);
    }
}

/// The ellipse of a footprint in a level, no longer than N times its width, with the texel's own
/// disc; no half axis above 32 texels.
FootprintAxes filter_axes(const Grid<u8vec4>& image, const Footprint& f, int max_anisotropy) {
  FootprintAxes axes = footprint_axes(f.dx, f.dy, image.width(), image.height());
  axes.minor = std::max(axes.minor, axes.major / max_anisotropy);
  axes.major = std::min(std::sqrt(axes.major * axes.major + 0.6), 32.0);
  axes.minor = std::min(std::sqrt(axes.minor * axes.minor + 0.6), 32.0);
  return axes;
}

/// A level of one texel is that texel.
struct LevelAverage {
  dvec4 value{0.0};
  int texels = 0;
};

LevelAverage average(const MippedTexture& t, std::size_t level, const Footprint& f) {
  const Grid<u8vec4>& image = t.levels[level];
  if (level + 1 == t.levels.size()) {
    const MippedTexture only{t.levels.subspan(level, 1), t.srgb, t.sampler};
    return {sample(only, f.uv, 0).value, 4};
  }
  LevelAverage sum;
  double weights = 0;
  visit_ellipse(image, f.uv, filter_axes(image, f, t.sampler.max_anisotropy),
                [&](std::int64_t x, std::int64_t y, double radius) {
                  const double weight = (1 - radius) * (1 - radius);
                  sum.value += weight * read_texel(image, t.srgb, x, y, t.sampler);
                  sum.texels += 1;
                  weights += weight;
                });
  sum.value /= weights;
  return sum;
}

/// The levels that an ellipse is averaged in, and the share of the coarser one.
struct LevelPair {
  std::size_t fine = 0;
  double coarse_share = 0;
};

LevelPair levels_of(const MippedTexture& t, const FootprintAxes& base, double bias) {
  const double width = std::max({base.minor, base.major / t.sampler.max_anisotropy, 1.0});
  const double place = std::clamp(std::log2(width) + bias, 0.0, double(t.levels.size()) - 1);
  const double level = std::floor(place);
  return {std::size_t(level), std::max(0.0, 4 * (place - level) - 3)};
}

LevelAverage averaged(const MippedTexture& t, const Footprint& f, const FootprintAxes& base,
                      double bias) {
  const LevelPair levels = levels_of(t, base, bias);
  LevelAverage sum = average(t, levels.fine, f);
  if (levels.coarse_share > 0) {
    const LevelAverage coarse = average(t, levels.fine + 1, f);
    sum.value = glm::mix(sum.value, coarse.value, levels.coarse_share);
    sum.texels += coarse.texels;
  }
  return sum;
}

FootprintAxes base_axes(const MippedTexture& t, const Footprint& f) {
  return footprint_axes(f.dx, f.dy, t.levels[0].width(), t.levels[0].height());
}

bool covers_texels(const MippedTexture& t, const FootprintAxes& base) {
  return is_anisotropic(t.sampler) && base.major > 1 && base.major < 1e9;
}

}  // namespace

bool is_anisotropic(const Sampler& s) {
  return s.max_anisotropy > 1 && s.mag == Filter::linear && s.min == Filter::linear &&
         s.mip == Filter::linear;
}

FootprintAxes footprint_axes(dvec2 uv_dx, dvec2 uv_dy, int width, int height) {
  const dvec2 size{double(width), double(height)};
  const dvec2 x = uv_dx * size;
  const dvec2 y = uv_dy * size;
  // [x y] is a similarity (e, h) plus a reflected one (f, g).
  const double e = (x.x + y.y) / 2, f = (x.x - y.y) / 2;
  const double g = (x.y + y.x) / 2, h = (x.y - y.x) / 2;
  const double q = std::hypot(e, h), r = std::hypot(f, g);
  const double angle = (std::atan2(g, f) + std::atan2(h, e)) / 2;
  return {q + r, std::abs(q - r), {std::cos(angle), std::sin(angle)}};
}

TextureLookup sample(const MippedTexture& t, const Footprint& f, double level_bias) {
  const FootprintAxes base = base_axes(t, f);
  if (!covers_texels(t, base)) {
    const double lambda = level_of_detail(f.dx, f.dy, t.levels[0].width(), t.levels[0].height());
    // A small footprint magnifies, whatever its shape.
    return sample(t, f.uv, is_anisotropic(t.sampler) && base.major <= 1 ? 0.0 : lambda);
  }
  const dvec4 mean = averaged(t, f, base, level_bias).value;
  const double share = base.major * base.major - 1;
  if (share >= 1) return {mean, 0};
  return {glm::mix(sample(t, f.uv, 0).value, mean, share), 0};
}

int texels_read(const MippedTexture& t, const Footprint& f, double level_bias) {
  const FootprintAxes base = base_axes(t, f);
  if (covers_texels(t, base))
    return averaged(t, f, base, level_bias).texels + (base.major * base.major < 2 ? 4 : 0);
  const double lambda = level_of_detail(f.dx, f.dy, t.levels[0].width(), t.levels[0].height());
  const bool two_levels =
      lambda > 0 && lambda < double(t.levels.size()) - 1 && lambda != std::floor(lambda);
  return two_levels ? 8 : 4;
}

dvec4 elliptical_weighted_average(const MippedTexture& t, const Footprint& f) {
  const Grid<u8vec4>& image = t.levels[0];
  FootprintAxes axes = footprint_axes(f.dx, f.dy, image.width(), image.height());
  axes.major = std::sqrt(axes.major * axes.major + 1);
  axes.minor = std::sqrt(axes.minor * axes.minor + 1);
  dvec4 sum{0.0};
  double weights = 0;
  visit_ellipse(image, f.uv, axes, [&](std::int64_t x, std::int64_t y, double radius) {
    const double weight = std::exp(-2 * radius) - std::exp(-2.0);
    sum += weight * read_texel(image, t.srgb, x, y, t.sampler);
    weights += weight;
  });
  return sum / weights;
}

}  // namespace parity::cpu
