#version 460
#include "raster/layout.h"

// Reads a colour target of any format; one thread a pixel.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { FullScreenArgs args; };
layout(binding = 0) uniform sampler2D image;

void main() {
  const ivec2 size = textureSize(image, 0);
  const uint i = gl_GlobalInvocationID.x;
  if (i >= uint(size.x * size.y)) return;
  args.texels.at[i] = texelFetch(image, ivec2(i % args.width, i / args.width), 0);
}
