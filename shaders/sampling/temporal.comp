#version 460
#include "sampling/temporal.glsl"

// One thread a pixel. Source: notes 1.8; Karis 2014.
layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar, push_constant) uniform Push { TemporalArgs args; };

void main() {
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  if (pixel.x >= args.width || pixel.y >= args.height) return;
  args.result.at[pixel.y * args.width + pixel.x] = accumulated(args, pixel);
}
