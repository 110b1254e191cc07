#include "geometry/mip_pyramid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace parity {
namespace {

float linear_from_code(int code) {
  const double c = code / 255.0;
  return float(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
}

/// Code of the nearest sRGB value: the table's midpoints decide, so no power is taken per texel.
class SrgbCodes {
 public:
  SrgbCodes() {
    for (int code = 0; code < 256; ++code) linear_[std::size_t(code)] = linear_from_code(code);
    for (int code = 0; code < 255; ++code) {
      const double middle = (code + 0.5) / 255.0;
      border_[std::size_t(code)] =
          float(middle <= 0.04045 ? middle / 12.92 : std::pow((middle + 0.055) / 1.055, 2.4));
    }
  }
  float decode(int code) const { return linear_[std::size_t(code)]; }
  std::uint8_t encode(float value) const {
    return std::uint8_t(std::upper_bound(border_.begin(), border_.end(), value) - border_.begin());
  }

 private:
  std::array<float, 256> linear_;
  std::array<float, 255> border_;
};

/// Up to three neighbours along one axis and their weights: the overlap of [i n/m, (i+1) n/m).
struct Taps {
  int first = 0;
  int count = 0;
  std::array<float, 3> weight{};
};

std::vector<Taps> box_taps(int from, int to) {
  std::vector<Taps> taps(std::size_t(to), Taps{});
  for (int i = 0; i < to; ++i) {
    const double begin = double(i) * from / to;
    const double end = double(i + 1) * from / to;
    Taps& t = taps[std::size_t(i)];
    t.first = int(begin);
    for (int j = t.first; j < std::min(from, int(std::ceil(end))) && t.count < 3; ++j)
      t.weight[std::size_t(t.count++)] =
          float((std::min(end, j + 1.0) - std::max(begin, double(j))) / (end - begin));
  }
  return taps;
}

Grid<vec4> decode(const Grid<u8vec4>& image, bool srgb, const SrgbCodes& codes) {
  Grid<vec4> linear{image.width(), image.height()};
  std::transform(image.begin(), image.end(), linear.begin(), [&](const u8vec4& t) {
    if (srgb)
      return vec4(codes.decode(t.x), codes.decode(t.y), codes.decode(t.z), float(t.w) / 255.0f);
    return vec4(t) / 255.0f;
  });
  return linear;
}

Grid<u8vec4> encode(const Grid<vec4>& linear, bool srgb, const SrgbCodes& codes) {
  Grid<u8vec4> image{linear.width(), linear.height()};
  const auto unorm = [](float v) { return std::uint8_t(v * 255.0f + 0.5f); };
  std::transform(linear.begin(), linear.end(), image.begin(), [&](const vec4& v) {
    if (srgb) return u8vec4(codes.encode(v.x), codes.encode(v.y), codes.encode(v.z), unorm(v.w));
    return u8vec4(unorm(v.x), unorm(v.y), unorm(v.z), unorm(v.w));
  });
  return image;
}

Grid<vec4> halve(const Grid<vec4>& image) {
  const int width = std::max(1, image.width() / 2);
  const int height = std::max(1, image.height() / 2);
  const std::vector<Taps> across = box_taps(image.width(), width);
  const std::vector<Taps> down = box_taps(image.height(), height);
  Grid<vec4> half{width, height};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Taps& v = down[std::size_t(y)];
      const Taps& u = across[std::size_t(x)];
      vec4 sum{0.0f};
      for (int j = 0; j < v.count; ++j)
        for (int i = 0; i < u.count; ++i)
          sum += image(u.first + i, v.first + j) *
                 (u.weight[std::size_t(i)] * v.weight[std::size_t(j)]);
      half(x, y) = sum;
    }
  return half;
}

}  // namespace

std::vector<Grid<u8vec4>> mip_pyramid(const Grid<u8vec4>& image, bool srgb) {
  if (image.empty()) throw std::invalid_argument("mip_pyramid: the image is empty");
  static const SrgbCodes codes;
  std::vector<Grid<u8vec4>> levels{image};
  if (image.width() == 1 && image.height() == 1) return levels;
  for (Grid<vec4> linear = halve(decode(image, srgb, codes));; linear = halve(linear)) {
    levels.push_back(encode(linear, srgb, codes));
    if (linear.width() == 1 && linear.height() == 1) return levels;
  }
}

}  // namespace parity
