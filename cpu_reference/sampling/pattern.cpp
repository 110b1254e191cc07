#include "cpu_reference/sampling/pattern.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

namespace parity::cpu {
namespace {

std::uint32_t hash(std::uint32_t x) {
  x = x * 747796405u + 2891336453u;
  x = ((x >> ((x >> 28) + 4)) ^ x) * 277803737u;
  return (x >> 22) ^ x;
}

/// The numbers that a seed gives.
class Numbers {
 public:
  explicit Numbers(std::uint32_t seed) : seed_(seed) {}
  std::uint32_t bits(std::uint32_t i, std::uint32_t dimension) const {
    return hash(i + hash(dimension + hash(seed_)));
  }
  double unit(std::uint32_t i, std::uint32_t dimension) const {
    return double(bits(i, dimension) >> 8) * 0x1p-24;
  }
  dvec2 point(std::uint32_t i, std::uint32_t first_dimension) const {
    return {unit(i, first_dimension), unit(i, first_dimension + 1)};
  }

 private:
  std::uint32_t seed_;
};

/// Kensler's permutation of 0..length - 1.
std::uint32_t permute(std::uint32_t i, std::uint32_t length, std::uint32_t key) {
  const std::uint32_t w = std::bit_ceil(length) - 1;
  do {
    i ^= key;
    i *= 0xe170893d;
    i ^= key >> 16;
    i ^= (i & w) >> 4;
    i ^= key >> 8;
    i *= 0x0929eb3f;
    i ^= key >> 23;
    i ^= (i & w) >> 1;
    i *= 1 | key >> 27;
    i *= 0x6935fa69;
    i ^= (i & w) >> 11;
    i *= 0x74dcb303;
    i ^= (i & w) >> 2;
    i *= 0x9e501cc3;
    i ^= (i & w) >> 2;
    i *= 0xc860a3df;
    i &= w;
    i ^= i >> 5;
  } while (i >= length);
  return (i + key) % length;
}

double radical_inverse(std::uint32_t i, std::uint32_t base) {
  double place = 1.0 / base;
  double sum = 0;
  for (; i > 0; i /= base, place /= base) sum += place * (i % base);
  return sum;
}

/// Bit j after the point is the sum modulo 2 of the bits k of i for which C(k, j) is odd, that is,
/// for which k has all the bits of j (Pascal's triangle modulo 2).
std::uint32_t pascal_digits(std::uint32_t i) {
  std::uint32_t result = 0;
  for (std::uint32_t j = 0; j < 32; ++j)
    for (std::uint32_t k = 0; k < 32; ++k)
      if ((k & j) == j) result ^= ((i >> k) & 1) << (31 - j);
  return result;
}

std::uint32_t reversed_bits(std::uint32_t i) {
  std::uint32_t result = 0;
  for (int k = 0; k < 32; ++k) result |= ((i >> k) & 1) << (31 - k);
  return result;
}

double upper_bits(std::uint32_t bits) { return double(bits >> 8) * 0x1p-24; }

std::vector<dvec2> blue_noise(std::uint32_t count, const Numbers& numbers) {
  constexpr std::int64_t whole = 1 << 15;
  const auto square = [](std::int64_t d) {
    d = std::min(std::abs(d), whole - std::abs(d));
    return d * d;
  };
  std::vector<uvec2> places;
  for (std::uint32_t i = 0; i < count; ++i) {
    uvec2 best{0};
    std::int64_t farthest = -1;
    for (std::uint32_t c = 0; c < 32; ++c) {
      const uvec2 place{numbers.bits(32 * i + c, 0) >> 17, numbers.bits(32 * i + c, 1) >> 17};
      std::int64_t nearest = 4 * whole * whole;
      for (const uvec2& other : places)
        nearest = std::min(nearest, square(std::int64_t(place.x) - other.x) +
                                        square(std::int64_t(place.y) - other.y));
      if (nearest > farthest) farthest = nearest, best = place;
    }
    places.push_back(best);
  }
  std::vector<dvec2> samples;
  for (const uvec2& place : places) samples.push_back(dvec2(place) / double(whole));
  return samples;
}

}  // namespace

std::vector<dvec2> pattern(SamplePattern pattern, std::uint32_t count, std::uint32_t seed) {
  if (count == 0) throw std::invalid_argument("cpu::pattern: count is 0, must be at least 1");
  const Numbers numbers(seed);
  if (pattern == SamplePattern::blue_noise) return blue_noise(count, numbers);
  const uvec2 cells = strata(count);
  const dvec2 shift = numbers.point(0, 2);
  const auto sample = [&](std::uint32_t i) -> dvec2 {
    const uvec2 cell{i % cells.x, i / cells.x};
    switch (pattern) {
      case SamplePattern::regular:
        return (dvec2(cell) + 0.5) / dvec2(cells);
      case SamplePattern::random:
        return numbers.point(i, 0);
      case SamplePattern::jittered:
        return (dvec2(cell) + numbers.point(i, 0)) / dvec2(cells);
      case SamplePattern::multi_jittered: {
        // The columns of the fine grid in one coarse column are dealt to its rows, and so on.
        const dvec2 fine{permute(cell.y, cells.y, hash(seed) * 0x63d83595u),
                         permute(cell.x, cells.x, hash(seed) * 0xa511e9b3u)};
        return (dvec2(cell) + (fine + numbers.point(i, 0)) / dvec2(cells.y, cells.x)) /
               dvec2(cells);
      }
      case SamplePattern::halton:
        return glm::fract(dvec2(radical_inverse(i, 2), radical_inverse(i, 3)) + shift);
      case SamplePattern::sobol:
        return {upper_bits(reversed_bits(i) ^ numbers.bits(0, 2)),
                upper_bits(pascal_digits(i) ^ numbers.bits(0, 3))};
      default: {
        constexpr double g = 1.3247179572447460;
        return glm::fract(double(i) / dvec2(g, g * g) + shift);
      }
    }
  };
  std::vector<dvec2> samples;
  for (std::uint32_t i = 0; i < count; ++i) samples.push_back(sample(i));
  return samples;
}

}  // namespace parity::cpu
