#version 460
#include "raster/layout.h"

// Reads the samples of a pixel out of multisampled targets; one thread a sample.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { FetchSamplesArgs args; };
layout(binding = 0) uniform sampler2DMS count_image;
layout(binding = 1) uniform usampler2DMS element_image;

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.width * args.height * args.samples) return;
  const uint pixel = i / args.samples;
  const ivec2 at = ivec2(pixel % args.width, pixel / args.width);
  args.counts.at[i] = texelFetch(count_image, at, int(i % args.samples)).x;
  args.elements.at[i] = texelFetch(element_image, at, int(i % args.samples)).x;
}
