#version 460
#include "raster/layout.h"

// Reads the samples of a pixel out of multisampled targets; one thread a pixel.
layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar, push_constant) uniform Push { FetchSamplesArgs args; };
layout(binding = 0) uniform sampler2DMS count_image;
layout(binding = 1) uniform usampler2DMS element_image;

void main() {
  const uvec2 at = gl_GlobalInvocationID.xy;
  if (at.x >= args.width || at.y >= args.height) return;
  const uint first = (at.y * args.width + at.x) * args.samples;
  for (uint s = 0u; s < args.samples; ++s) {
    args.counts.at[first + s] = texelFetch(count_image, ivec2(at), int(s)).x;
    args.elements.at[first + s] = texelFetch(element_image, ivec2(at), int(s)).x;
  }
}
