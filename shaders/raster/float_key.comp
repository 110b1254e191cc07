#version 460
#include "raster/layout.h"

// Turns a depth into an unsigned key whose ascending order is far to near, and numbers it; one
// thread a depth. -0 and 0 are equal. Source: notes 1.7; Terdiman 2000.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { FloatKeyArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  const uint bits = floatBitsToUint(args.depths.at[i]);
  const uint magnitude = bits & 0x7fffffffu;
  const bool negative = bits > 0x80000000u;
  const uint ascending = negative ? 0x80000000u - magnitude : 0x80000000u + magnitude;
  args.keys.at[i] = ~ascending;
  args.values.at[i] = i;
}
