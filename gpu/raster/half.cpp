#include "gpu/raster/half.h"

#include <bit>
#include <cstring>

namespace parity::gpu {

float float_from_half(std::uint16_t half) {
  const std::uint32_t sign = std::uint32_t(half & 0x8000u) << 16;
  const std::uint32_t rest = std::uint32_t(half & 0x7fffu) << 13;
  // Infinity and NaN keep their largest exponent; all else is off by 2^112, subnormals too.
  if ((half & 0x7c00u) == 0x7c00u) return std::bit_cast<float>(sign | 0x7f800000u | rest);
  const float magnitude = std::bit_cast<float>(rest) * 0x1p112f;
  return std::bit_cast<float>(sign | std::bit_cast<std::uint32_t>(magnitude));
}

std::vector<vec4> vec4_from_halves(const std::vector<std::uint32_t>& words) {
  std::vector<vec4> pixels(words.size() / 2);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const std::uint32_t low = words[2 * i];
    const std::uint32_t high = words[2 * i + 1];
    pixels[i] = {float_from_half(std::uint16_t(low)), float_from_half(std::uint16_t(low >> 16)),
                 float_from_half(std::uint16_t(high)), float_from_half(std::uint16_t(high >> 16))};
  }
  return pixels;
}

std::vector<vec4> vec4_from_floats(const std::vector<std::uint32_t>& words) {
  std::vector<vec4> pixels(words.size() / 4);
  if (!pixels.empty()) std::memcpy(pixels.data(), words.data(), pixels.size() * sizeof(vec4));
  return pixels;
}

}  // namespace parity::gpu
