#version 460
#include "sampling/layout.h"

// What a screen shows of each pixel, roughly: gamma 2, clipped; one thread a pixel.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { PixelNeedArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.width * args.height) return;
  const vec3 light = vec3(unpackHalf2x16(args.words.at[2u * i]), unpackHalf2x16(args.words.at[2u * i + 1u]).x);
  const uvec3 code = uvec3(1023.0 * sqrt(clamp(light * args.gain, 0.0, 1.0)) + 0.5);
  args.codes.at[i] = code.x | code.y << 10u | code.z << 20u;
}
