#version 460
#include "texture/layout.h"

// Reads a texture through the device's own sampler; one thread a footprint.
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform sampler2D image;
layout(scalar, push_constant) uniform Push { HardwareSampleArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  const TextureFootprint f = args.footprints.at[i];
  args.colors.at[i] = textureGrad(image, f.uv, f.uv_dx, f.uv_dy);
}
