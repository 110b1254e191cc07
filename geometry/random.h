#pragma once

#include <cstdint>

#include "geometry/math.h"

namespace parity {

/// PCG-XSH-RR 64/32: the generator of every random number. The same seed and stream give the same
/// numbers on every machine.
///
/// Source: O'Neill 2014, "PCG: A Family of Simple Fast Space-Efficient Statistically Good
/// Algorithms for Random Number Generation".
class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0) : increment_((stream << 1) | 1) {
    next();
    state_ += seed;
    next();
  }

  /// Uniform over all 32-bit numbers.
  std::uint32_t next() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005ULL + increment_;
    const auto shifted = std::uint32_t(((old >> 18) ^ old) >> 27);
    const auto turn = std::uint32_t(old >> 59);
    return (shifted >> turn) | (shifted << ((32 - turn) & 31));
  }

  /// Uniform in [low, high), of 2^24 equally spaced floats.
  float uniform(float low = 0.0f, float high = 1.0f) {
    return low + (high - low) * (float(next() >> 8) * 0x1p-24f);
  }

  /// Uniform in 0..count - 1; count > 0. Biased by less than count 2^-32.
  std::uint32_t below(std::uint32_t count) {
    return std::uint32_t((std::uint64_t(next()) * count) >> 32);
  }

  vec3 in_box(float half) {
    return {uniform(-half, half), uniform(-half, half), uniform(-half, half)};
  }

  /// Uniform on the unit sphere, by rejection.
  vec3 direction() {
    for (;;) {
      const vec3 v = in_box(1.0f);
      const float length = glm::length(v);
      if (length <= 1.0f && length > 0.1f) return v / length;
    }
  }

  /// Uniform over the rotations, by rejection.
  quat rotation() {
    for (;;) {
      const vec4 v{in_box(1.0f), uniform(-1.0f, 1.0f)};
      const float length = glm::length(v);
      if (length <= 1.0f && length > 0.1f)
        return quat(v.w / length, v.x / length, v.y / length, v.z / length);
    }
  }

 private:
  std::uint64_t state_ = 0;
  std::uint64_t increment_;
};

}  // namespace parity
