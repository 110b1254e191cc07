#include "cpu_reference/texture/mip_pyramid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "geometry/color.h"
#include "geometry/mip_pyramid.h"

namespace parity::cpu {
namespace {

/// Means over equal parts of a row of values, from its running sum: the sum up to a point inside a
/// value takes the share of it that lies before.
class RunningSum {
 public:
  explicit RunningSum(int count) : sums_(std::size_t(count) + 1, dvec4(0.0)) {}
  template <typename ValueAt>
  void fill(const ValueAt& value_at) {
    for (std::size_t i = 1; i < sums_.size(); ++i) sums_[i] = sums_[i - 1] + value_at(int(i) - 1);
  }
  dvec4 mean(int part, int parts) const {
    const int count = int(sums_.size()) - 1;
    return (up_to(part + 1, parts) - up_to(part, parts)) * (double(parts) / count);
  }

 private:
  /// The sum up to value number count * part / parts.
  dvec4 up_to(int part, int parts) const {
    const std::int64_t place = std::int64_t(sums_.size() - 1) * part;
    const auto whole = std::size_t(place / parts);
    const double share = double(place % parts) / parts;
    if (share == 0) return sums_[whole];
    return sums_[whole] + (sums_[whole + 1] - sums_[whole]) * share;
  }

  std::vector<dvec4> sums_;
};

Grid<dvec4> halve_rows(const Grid<dvec4>& image, int width) {
  Grid<dvec4> half{width, image.height()};
  RunningSum sum(image.width());
  for (int y = 0; y < image.height(); ++y) {
    sum.fill([&](int x) { return image(x, y); });
    for (int x = 0; x < width; ++x) half(x, y) = sum.mean(x, width);
  }
  return half;
}

Grid<dvec4> halve_columns(const Grid<dvec4>& image, int height) {
  Grid<dvec4> half{image.width(), height};
  RunningSum sum(image.height());
  for (int x = 0; x < image.width(); ++x) {
    sum.fill([&](int y) { return image(x, y); });
    for (int y = 0; y < height; ++y) half(x, y) = sum.mean(y, height);
  }
  return half;
}

Grid<dvec4> decode(const Grid<u8vec4>& image, bool srgb) {
  std::array<double, 256> table{};
  for (std::size_t code = 0; code < 256; ++code)
    table[code] = srgb ? linear_from_srgb(double(code) / 255) : double(code) / 255;
  Grid<dvec4> linear{image.width(), image.height()};
  std::transform(image.begin(), image.end(), linear.begin(),
                 [&](u8vec4 t) { return dvec4(table[t.x], table[t.y], table[t.z], t.w / 255.0); });
  return linear;
}

Grid<dvec4> stored(const Grid<dvec4>& linear, bool srgb) {
  Grid<dvec4> values{linear.width(), linear.height()};
  std::transform(linear.begin(), linear.end(), values.begin(), [&](dvec4 v) {
    if (srgb) v = {srgb_from_linear(v.x), srgb_from_linear(v.y), srgb_from_linear(v.z), v.w};
    return v * 255.0;
  });
  return values;
}

}  // namespace

std::vector<Grid<dvec4>> mip_means(const Grid<u8vec4>& image, bool srgb) {
  if (image.empty()) throw std::invalid_argument("cpu::mip_pyramid: the image is empty");
  std::vector<Grid<dvec4>> means;
  Grid<dvec4> linear = decode(image, srgb);
  for (const MipLevel& level : mip_levels(image.width(), image.height())) {
    if (level.width != linear.width()) linear = halve_rows(linear, level.width);
    if (level.height != linear.height()) linear = halve_columns(linear, level.height);
    means.push_back(stored(linear, srgb));
  }
  return means;
}

std::vector<Grid<u8vec4>> round_pyramid(const std::vector<Grid<dvec4>>& means, double error) {
  std::vector<Grid<u8vec4>> levels;
  for (const Grid<dvec4>& level : means) {
    // Level 0 was not computed: it is what it is.
    const double shift = levels.empty() ? 0.5 : 0.5 - error;
    Grid<u8vec4>& codes = levels.emplace_back(level.width(), level.height());
    std::transform(level.begin(), level.end(), codes.begin(), [&](const dvec4& v) {
      return u8vec4(glm::clamp(glm::floor(v + shift), 0.0, 255.0));
    });
  }
  return levels;
}

std::vector<Grid<u8vec4>> mip_pyramid(const Grid<u8vec4>& image, bool srgb) {
  return round_pyramid(mip_means(image, srgb), 0.0);
}

}  // namespace parity::cpu
