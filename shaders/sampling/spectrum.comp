#version 460
#include "sampling/fourier.glsl"

// One pass of radix 2, 3, 4 or 5 of a Fourier transform; one thread a butterfly. Source: notes 1.8;
// Stockham 1966.
layout(local_size_x = 64) in;
layout(constant_id = 0) const uint radix = 4u;
layout(constant_id = 1) const uint inverse = 0u;
layout(scalar, push_constant) uniform Push { SpectrumArgs args; };

// v times exp(-+2 pi i k / radix). Quarter turns are exact.
vec2 turned(vec2 v, uint k) {
  if (radix == 3u || radix == 5u)
    return complex_product(v, args.roots.at[k * (args.count / radix)]);
  const uint quarters = k * (4u / radix);
  if (quarters == 0u) return v;
  if (quarters == 2u) return -v;
  return (quarters == 1u) == (inverse == 0u) ? vec2(v.y, -v.x) : vec2(-v.y, v.x);
}

void main() {
  const uvec2 at = line_and_element(args, gl_GlobalInvocationID.xy);
  if (at.x >= args.lines || at.y >= args.count / radix) return;
  vec2 v[radix];
  [[unroll]] for (uint q = 0u; q < radix; ++q) v[q] = turned_input(args, at.x, at.y, q);
  [[unroll]] for (uint r = 0u; r < radix; ++r) {
    vec2 sum = v[0];
    [[unroll]] for (uint q = 1u; q < radix; ++q) {
      precise vec2 next = sum + turned(v[q], q * r % radix);
      sum = next;
    }
    store_output(args, at.x, at.y, r, sum);
  }
}
