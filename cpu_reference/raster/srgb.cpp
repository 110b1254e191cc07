#include "cpu_reference/raster/srgb.h"

#include <cmath>
#include <cstdint>

namespace parity::cpu {
namespace {

/// Clamped to 0..1; NaN becomes 0.
double saturate(double value) { return value > 0.0 ? (value < 1.0 ? value : 1.0) : 0.0; }

std::uint8_t level(double value) { return std::uint8_t(std::floor(value * 255.0 + 0.5)); }

}  // namespace

double srgb_from_linear(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

Grid<u8vec4> encode_srgb(const Grid<vec4>& linear, float exposure) {
  Grid<u8vec4> encoded{linear.width(), linear.height()};
  const double gain = std::exp2(double(exposure));
  for (std::size_t i = 0; i < linear.size(); ++i) {
    const dvec4 color{linear.values()[i]};
    const auto code = [&](double c) { return level(srgb_from_linear(saturate(c * gain))); };
    encoded.values()[i] = {code(color.x), code(color.y), code(color.z), level(saturate(color.w))};
  }
  return encoded;
}

}  // namespace parity::cpu
