#include "cpu_reference/texture/answers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cpu_reference/texture/sample.h"
#include "cpu_reference/texture/texel.h"
#include "geometry/color.h"

namespace parity::cpu {
namespace {

void include(ColorBox& box, const ColorBox& other) {
  box.low = glm::min(box.low, other.low);
  box.high = glm::max(box.high, other.high);
}

ColorBox mixed(const ColorBox& a, const ColorBox& b, double weight) {
  return {a.low * (1 - weight) + b.low * weight, a.high * (1 - weight) + b.high * weight};
}

/// A texel with the error of decoding it.
ColorBox texel_box(const MippedTexture& t, int level, std::int64_t x, std::int64_t y,
                   const SamplerPrecision& p) {
  const dvec4 value = read_texel(t.levels[std::size_t(level)], t.srgb, x, y, t.sampler);
  ColorBox box{value, value};
  if (!t.srgb) return box;
  for (int c = 0; c < 3; ++c) {
    const double code = srgb_from_linear(value[c]);
    box.low[c] = std::min(value[c], linear_from_srgb(code - p.srgb_decode / 255));
    box.high[c] = std::max(value[c], linear_from_srgb(code + p.srgb_decode / 255));
  }
  return box;
}

/// A texel coordinate with its error.
struct Span {
  double low = 0;
  double high = 0;
};

Span coordinate(double uv, int size, double shift, double error) {
  const double c = bounded_coordinate(uv * size);
  const double e = error * (1 + std::abs(c));
  return {c - shift - e, c - shift + e};
}

std::vector<ColorBox> nearest(const MippedTexture& t, dvec2 uv, int level,
                              const SamplerPrecision& p) {
  const Grid<u8vec4>& image = t.levels[std::size_t(level)];
  const Span u = coordinate(uv.x, image.width(), 0, p.coordinate);
  const Span v = coordinate(uv.y, image.height(), 0, p.coordinate);
  const double e = p.texel_weight;
  std::vector<ColorBox> boxes;
  for (double y = std::floor(v.low - e); y <= std::floor(v.high + e); ++y)
    for (double x = std::floor(u.low - e); x <= std::floor(u.high + e); ++x)
      boxes.push_back(texel_box(t, level, std::int64_t(x), std::int64_t(y), p));
  return boxes;
}

/// One axis of a bilinear filter: a texel, and the weights that the next one may have.
struct Weights {
  double texel = 0;
  double low = 0;
  double high = 0;
};

std::vector<Weights> weights(Span c, double error) {
  std::vector<Weights> all;
  for (double texel = std::floor(c.low - error); texel <= std::floor(c.high + error); ++texel)
    all.push_back({texel, std::clamp(c.low - error - texel, 0.0, 1.0),
                   std::clamp(c.high + error - texel, 0.0, 1.0)});
  return all;
}

/// The filter is linear in each weight, so its extremes are at their ends.
std::vector<ColorBox> linear(const MippedTexture& t, dvec2 uv, int level,
                             const SamplerPrecision& p) {
  const Grid<u8vec4>& image = t.levels[std::size_t(level)];
  const Span u = coordinate(uv.x, image.width(), 0.5, p.coordinate);
  const Span v = coordinate(uv.y, image.height(), 0.5, p.coordinate);
  std::vector<ColorBox> boxes;
  for (const Weights& down : weights(v, p.texel_weight))
    for (const Weights& right : weights(u, p.texel_weight)) {
      const auto texel = [&](int i, int j) {
        return texel_box(t, level, std::int64_t(right.texel) + i, std::int64_t(down.texel) + j, p);
      };
      const ColorBox corners[] = {texel(0, 0), texel(1, 0), texel(0, 1), texel(1, 1)};
      const auto at = [&](double a, double b) {
        return mixed(mixed(corners[0], corners[1], a), mixed(corners[2], corners[3], a), b);
      };
      ColorBox box = at(right.low, down.low);
      include(box, at(right.high, down.low));
      include(box, at(right.low, down.high));
      include(box, at(right.high, down.high));
      boxes.push_back(box);
    }
  return boxes;
}

std::vector<ColorBox> filtered(const MippedTexture& t, Filter filter, dvec2 uv, int level,
                               const SamplerPrecision& p) {
  return filter == Filter::nearest ? nearest(t, uv, level, p) : linear(t, uv, level, p);
}

void append(std::vector<ColorBox>& all, const std::vector<ColorBox>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

std::vector<ColorBox> nearest_levels(const MippedTexture& t, dvec2 uv, LevelRange lambda,
                                     const SamplerPrecision& p) {
  const double last = double(t.levels.size()) - 1;
  const double from = std::clamp(std::ceil(std::min(lambda.low, last) + 0.5) - 1, 0.0, last);
  const double to = std::clamp(std::floor(std::min(lambda.high, last) + 0.5), 0.0, last);
  std::vector<ColorBox> boxes;
  for (double level = from; level <= to; ++level)
    append(boxes, filtered(t, t.sampler.min, uv, int(level), p));
  return boxes;
}

std::vector<ColorBox> mixed_levels(const MippedTexture& t, dvec2 uv, LevelRange lambda,
                                   const SamplerPrecision& p) {
  const double last = double(t.levels.size()) - 1;
  const double from = std::clamp(lambda.low - p.level_weight, 0.0, last);
  const double to = std::clamp(lambda.high + p.level_weight, 0.0, last);
  std::vector<ColorBox> boxes;
  for (double level = std::floor(from); level <= std::floor(to); ++level) {
    const double low = std::clamp(from - level, 0.0, 1.0);
    const double high = std::clamp(to - level, 0.0, 1.0);
    const int next = int(std::min(level + 1, last));
    const std::vector<ColorBox> coarse = filtered(t, t.sampler.min, uv, next, p);
    for (const ColorBox& a : filtered(t, t.sampler.min, uv, int(level), p))
      for (const ColorBox& b : coarse) {
        boxes.push_back(mixed(a, b, low));
        include(boxes.back(), mixed(a, b, high));
      }
  }
  return boxes;
}

}  // namespace

LevelRange allowed_levels(dvec2 uv_dx, dvec2 uv_dy, int width, int height, int bits) {
  const dvec2 size{double(width), double(height)};
  const dvec2 x = glm::abs(uv_dx * size);
  const dvec2 y = glm::abs(uv_dy * size);
  const double least = std::max({x.x, x.y, y.x, y.y});
  const double most = std::sqrt(2.0) * std::max(x.x + x.y, y.x + y.y);
  const double error = std::exp2(-bits);
  return {std::log2(least) - error, std::log2(most) + error};
}

std::vector<ColorBox> sample_answers(const MippedTexture& t, dvec2 uv, LevelRange lambda,
                                     const SamplerPrecision& p) {
  const Sampler& s = t.sampler;
  std::vector<ColorBox> boxes;
  if (!(lambda.low > 0)) boxes = filtered(t, s.mag, uv, 0, p);
  if (!(lambda.high > 0)) return boxes;
  if (!s.mip)
    append(boxes, filtered(t, s.min, uv, 0, p));
  else
    append(boxes, *s.mip == Filter::nearest ? nearest_levels(t, uv, lambda, p)
                                            : mixed_levels(t, uv, lambda, p));
  return boxes;
}

dvec4 moved_by(const MippedTexture& t, const Footprint& f, dvec2 place_error,
               double derivative_error) {
  const dvec4 here = sample(t, f).value;
  const dvec2 size{double(t.levels[0].width()), double(t.levels[0].height())};
  const dvec2 derivative =
      derivative_error * std::max(glm::length(f.dx * size), glm::length(f.dy * size)) / size;
  dvec4 sum{0.0};
  for (dvec2 Footprint::*part : {&Footprint::uv, &Footprint::dx, &Footprint::dy})
    for (int axis = 0; axis < 2; ++axis) {
      const double step = (part == &Footprint::uv ? place_error : derivative)[axis];
      Footprint up = f, down = f;
      (up.*part)[axis] += step;
      (down.*part)[axis] -= step;
      sum += glm::max(glm::abs(sample(t, up).value - here), glm::abs(sample(t, down).value - here));
    }
  return sum;
}

double distance_to(const std::vector<ColorBox>& answers, dvec4 color) {
  double nearest_box = std::numeric_limits<double>::infinity();
  for (const ColorBox& box : answers) {
    const dvec4 outside = glm::max(glm::max(box.low - color, color - box.high), dvec4(0.0));
    nearest_box = std::min(nearest_box, std::max({outside.x, outside.y, outside.z, outside.w}));
  }
  return nearest_box;
}

}  // namespace parity::cpu
