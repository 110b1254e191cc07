#version 460
#include "raster/layout.h"

// A texel of a buffer, for the blender. Helper invocations read too, also beside the picture.
layout(scalar, push_constant) uniform Push { FullScreenArgs args; };
layout(location = 0) out vec4 color;

void main() {
  const uvec2 at = min(uvec2(gl_FragCoord.xy), uvec2(args.width, args.height) - 1u);
  color = args.texels.at[at.y * args.width + at.x];
}
