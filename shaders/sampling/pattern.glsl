#include "sampling/layout.h"

// Samples of a pixel. Sources: notes 1.8; Jarzynski & Olano 2020 (hash); Kensler 2013 (correlated
// multi-jittering); Halton 1964; Sobol 1967; Roberts 2018 (R2).

const uint pattern_regular = 0u, pattern_random = 1u, pattern_jittered = 2u,
           pattern_multi_jittered = 3u, pattern_halton = 4u, pattern_sobol = 5u, pattern_r2 = 6u;

// PCG of 32 bits, output RXS-M-XS.
uint pcg_hash(uint x) {
  const uint state = x * 747796405u + 2891336453u;
  const uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return (word >> 22u) ^ word;
}

// Number `dimension` of sample i: 32 random bits.
uint random_bits(uint seed, uint i, uint dimension) {
  return pcg_hash(i + pcg_hash(dimension + pcg_hash(seed)));
}

// The upper 24 bits as a number in [0, 1).
float unit_float(uint bits) { return float(bits >> 8u) * 5.9604644775390625e-8; }

// Where i goes in permutation `p` of 0..count - 1: cycle walking on a mixing of the bits.
uint permuted(uint i, uint count, uint p) {
  if (count == 1u) return 0u;
  uint mask = count - 1u;
  mask |= mask >> 1u;
  mask |= mask >> 2u;
  mask |= mask >> 4u;
  mask |= mask >> 8u;
  mask |= mask >> 16u;
  for (uint turn = 0u; turn < 4096u; ++turn) {
    i = (i ^ p) * 0xe170893du;
    i ^= p >> 16u;
    i ^= (i & mask) >> 4u;
    i ^= p >> 8u;
    i *= 0x0929eb3fu;
    i ^= p >> 23u;
    i ^= (i & mask) >> 1u;
    i *= 1u | p >> 27u;
    i *= 0x6935fa69u;
    i ^= (i & mask) >> 11u;
    i *= 0x74dcb303u;
    i ^= (i & mask) >> 2u;
    i *= 0x9e501cc3u;
    i ^= (i & mask) >> 2u;
    i *= 0xc860a3dfu;
    i &= mask;
    i ^= i >> 5u;
    if (i < count) break;
  }
  return (i + p) % count;
}

// Digits of i to base 3, turned over.
float radical_inverse_3(uint i) {
  uint reversed = 0u, scale = 1u;
  for (uint digit = 0u; digit < 15u; ++digit) {
    reversed = reversed * 3u + i % 3u;
    scale *= 3u;
    i /= 3u;
  }
  return float(reversed) / float(scale);
}

// Second dimension of Sobol's sequence: primitive polynomial x + 1.
uint sobol_1(uint i) {
  uint bits = 0u;
  for (uint direction = 1u << 31u; i != 0u; i >>= 1u, direction ^= direction >> 1u)
    if ((i & 1u) != 0u) bits ^= direction;
  return bits;
}

vec2 stratified(vec2 cell, uint columns, uint rows, vec2 within) {
  return (cell + within) / vec2(columns, rows);
}

vec2 multi_jittered(uint i, uint columns, uint rows, uint seed, vec2 within) {
  const uint x = i % columns, y = i / columns;
  const float sx = float(permuted(x, columns, pcg_hash(seed) * 0xa511e9b3u));
  const float sy = float(permuted(y, rows, pcg_hash(seed) * 0x63d83595u));
  return vec2((float(x) + (sy + within.x) / float(rows)) / float(columns),
              (float(y) + (sx + within.y) / float(columns)) / float(rows));
}

vec2 pattern_sample(uint pattern, uint i, uint count, uint columns, uint seed) {
  const uint rows = count / columns;
  const vec2 cell = vec2(i % columns, i / columns);
  const vec2 within = vec2(unit_float(random_bits(seed, i, 0u)), unit_float(random_bits(seed, i, 1u)));
  const uvec2 shift = uvec2(random_bits(seed, 0u, 2u), random_bits(seed, 0u, 3u));
  switch (pattern) {
    case pattern_regular: return stratified(cell, columns, rows, vec2(0.5));
    case pattern_random: return within;
    case pattern_jittered: return stratified(cell, columns, rows, within);
    case pattern_multi_jittered: return multi_jittered(i, columns, rows, seed, within);
    case pattern_halton:
      return fract(vec2(unit_float(bitfieldReverse(i)), radical_inverse_3(i)) +
                   vec2(unit_float(shift.x), unit_float(shift.y)));
    case pattern_sobol:
      return vec2(unit_float(bitfieldReverse(i) ^ shift.x), unit_float(sobol_1(i) ^ shift.y));
  }
  // 2^32 / g and 2^32 / g^2: whole turns fall off by themselves.
  return vec2(unit_float(3242174889u * i + shift.x), unit_float(2447445414u * i + shift.y));
}
