#version 460
#include "raster/blend.glsl"
#include "raster/layout.h"

// Stacks the layers of a pixel, the first at the bottom, on transparent black; one thread a pixel.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { BlendArgs args; };

void main() {
  const uint pixel = gl_GlobalInvocationID.x;
  if (pixel >= args.pixel_count) return;
  vec4 color = vec4(0.0);
  for (uint layer = 0u; layer < args.layer_count; ++layer)
    color = blend(args.layers.at[layer * args.pixel_count + pixel], color, args.mode);
  args.result.at[pixel] = color;
}
