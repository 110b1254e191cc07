#version 460
#include "core/layout.h"

// Writes 1 - texel of a sampled image at binding 0 to a storage image at binding 2; one thread a texel.
layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar, push_constant) uniform Push { TestSamplesArgs args; };
layout(set = 0, binding = 0) uniform sampler2D source;
layout(set = 0, binding = 2, rgba32f) uniform writeonly image2D target;

void main() {
  const uvec2 p = gl_GlobalInvocationID.xy;
  if (p.x >= args.width || p.y >= args.height) return;
  imageStore(target, ivec2(p), 1 - texelFetch(source, ivec2(p), 0));
}
