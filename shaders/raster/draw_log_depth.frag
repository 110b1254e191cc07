#version 460
#include "raster/layout.h"

// The element, with logarithmic depth: log2(w / near) / log2(far / near). Source: notes 1.7.
layout(scalar, push_constant) uniform Push { DrawArgs args; };
layout(location = 0) flat in uint element;
layout(location = 0) out uint front;

void main() {
  front = element;
  gl_FragDepth = clamp(args.log_scale * log2(args.log_near * gl_FragCoord.w), 0.0, 1.0);
}
