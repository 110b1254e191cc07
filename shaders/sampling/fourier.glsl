#include "sampling/layout.h"

// Steps of a Fourier transform whose outputs come out in order (Stockham). Sources: notes 1.8;
// Stockham 1966; Govindaraju et al. 2008.

vec2 complex_product(vec2 a, vec2 b) {
  precise vec2 p = vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
  return p;
}

// Line and element of a thread.
uvec2 line_and_element(SpectrumArgs args, uvec2 id) {
  return args.lines_first != 0u ? id.xy : id.yx;
}

// Input q of the radix inputs of butterfly j, turned by its twiddle factor.
vec2 turned_input(SpectrumArgs args, uint line, uint j, uint q) {
  const uint butterflies = args.count / args.radix;
  const vec2 value =
      args.from.at[line * args.line_stride + (j + q * butterflies) * args.element_stride];
  const uint turn = (j % args.done) * q * (butterflies / args.done);
  return complex_product(value, args.roots.at[turn]);
}

void store_output(SpectrumArgs args, uint line, uint j, uint r, vec2 value) {
  const uint low = j % args.done;
  const uint element = (j - low) * args.radix + low + r * args.done;
  args.to.at[line * args.line_stride + element * args.element_stride] = value * args.scale;
}
