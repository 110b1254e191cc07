#version 460
#include "sampling/layout.h"

// What a screen shows of each pixel, roughly: gamma 2, clipped; and how much of what will be put behind
// the picture. One thread a pixel.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { PixelNeedArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.width * args.height) return;
  const vec2 first = unpackHalf2x16(args.words.at[2u * i]), second = unpackHalf2x16(args.words.at[2u * i + 1u]);
  const vec3 light = vec3(first, second.x) * args.gain;
  const vec4 shown = vec4(sqrt(clamp(light, 0.0, 1.0)), clamp(second.y, 0.0, 1.0));
  const uvec4 code = floatBitsToUint(255.0 * shown + 8388608.0) & 255u;  // 2^23 + x has no fraction
  args.codes.at[i] = code.x | code.y << 8u | code.z << 16u | code.w << 24u;
}
