#version 460
#include "raster/layout.h"

// A texel of a buffer, for the blender.
layout(scalar, push_constant) uniform Push { FullScreenArgs args; };
layout(location = 0) out vec4 color;

void main() {
  const uvec2 at = uvec2(gl_FragCoord.xy);
  color = args.texels.at[at.y * args.width + at.x];
}
