#version 460
#include "sampling/fourier.glsl"

// One pass of a large prime radix of a Fourier transform; one thread an output. Source: notes 1.8.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { SpectrumArgs args; };

void main() {
  const uvec2 at = line_and_element(args, gl_GlobalInvocationID.xy);
  if (at.x >= args.lines || at.y >= args.count) return;
  const uint butterflies = args.count / args.radix;
  const uint j = at.y % butterflies, r = at.y / butterflies;
  vec2 sum = vec2(0.0);
  for (uint q = 0u; q < args.radix; ++q) {
    const vec2 turn = args.roots.at[(q * r % args.radix) * butterflies];
    precise vec2 next = sum + complex_product(turned_input(args, at.x, j, q), turn);
    sum = next;
  }
  store_output(args, at.x, j, r, sum);
}
