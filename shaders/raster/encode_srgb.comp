#version 460
#include "raster/srgb.glsl"

// Exposes and encodes a pixel; one thread a pixel.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { EncodeArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  const vec4 color = args.colors.at[i];
  precise vec3 exposed = color.rgb * args.scale;
  args.codes.at[i] = srgb_codes(vec4(exposed, color.a), args.thresholds);
}
