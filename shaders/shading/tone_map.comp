#version 460
#include "shading/layout.h"
#include "shading/tone_map.glsl"

// Exposes and maps a pixel to what a screen can show; one thread a pixel. Alpha stays.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { ToneMapArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  const vec4 c = args.colors.at[i];
  args.colors.at[i] = vec4(tone_map(c.rgb * args.gain, args.tone_map), c.a);
}
