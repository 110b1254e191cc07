#version 460
#include "sampling/pattern.glsl"

// The next sample of blue noise: of 32 random candidates the one whose nearest neighbour on the
// torus is farthest, the first of equals; one thread a candidate, one group in all. Distances are
// whole numbers. Source: Mitchell 1991.
layout(local_size_x = 32) in;
layout(scalar, push_constant) uniform Push { BlueNoiseArgs args; };

shared uint nearest[32];

uvec2 candidate(uint c) {
  const uint number = args.done * 32u + c;
  return uvec2(random_bits(args.seed, number, 0u), random_bits(args.seed, number, 1u)) >> 17u;
}

void main() {
  const uint c = gl_LocalInvocationID.x;
  const uvec2 place = candidate(c);
  uint least = 0xffffffffu;
  for (uint i = 0u; i < args.done; ++i) {
    const uvec2 apart = (args.places.at[i] - place) & 32767u;
    const uvec2 torus = min(apart, 32768u - apart);
    least = min(least, torus.x * torus.x + torus.y * torus.y);
  }
  nearest[c] = least;
  barrier();
  if (c != 0u) return;
  uint best = 0u;
  for (uint k = 1u; k < 32u; ++k)
    if (nearest[k] > nearest[best]) best = k;
  args.places.at[args.done] = candidate(best);
}
