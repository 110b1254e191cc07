#version 460
#include "core/layout.h"

// Reads every sample of a multisampled image; one thread a pixel.
layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar, push_constant) uniform Push { TestSamplesArgs args; };
layout(set = 0, binding = 0) uniform sampler2DMS image;

void main() {
  const uvec2 p = gl_GlobalInvocationID.xy;
  if (p.x >= args.width || p.y >= args.height) return;
  for (uint s = 0; s < args.sample_count; ++s)
    args.results.at[(p.y * args.width + p.x) * args.sample_count + s] = texelFetch(image, ivec2(p), int(s));
}
