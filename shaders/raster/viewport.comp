#version 460
#include "raster/layout.h"
#include "raster/viewport.glsl"

// Divides by w and maps to the window; one thread a position. Source: notes 1.2; Vulkan 1.3.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { ViewportArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  args.window_positions.at[i] =
      window_position(args.clip_positions.at[i], vec2(args.width, args.height));
}
