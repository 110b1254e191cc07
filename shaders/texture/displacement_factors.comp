#version 460
#include "texture/displacement.glsl"

// Into how many parts a triangle's edges (opposite corners 0, 1, 2) and its inside are cut, and how
// many triangles that makes; one thread a triangle. Source: notes 6.3.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { DisplacementArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  uvec4 factors = uvec4(1u);
  [[dont_unroll]] for (uint k = 0u; k < 3u; ++k) {
    const DisplacementVertex a = args.vertices.at[3u * i + (k + 1u) % 3u];
    const DisplacementVertex b = args.vertices.at[3u * i + (k + 2u) % 3u];
    const DisplacementVertex opposite = args.vertices.at[3u * i + k];
    factors[k] = edge_factor(args, a, b);
    factors.w = max(factors.w, max(factors[k], edge_factor(args, opposite, between(a, b, 0.5))));
  }
  args.factors.at[i] = factors;
  args.begins.at[i] = factors.w * factors.w;
}
