#version 460
#include "sampling/layout.h"

// Adds a frame to the mean of several; one thread a pixel. Source: notes 1.8.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { FrameSumArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.pixel_count) return;
  const vec4 color = args.weight * vec4(unpackHalf2x16(args.words.at[2u * i]),
                                        unpackHalf2x16(args.words.at[2u * i + 1u]));
  args.colors.at[i] = args.is_first != 0u ? color : args.colors.at[i] + color;
}
