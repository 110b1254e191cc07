#version 460
#include "raster/layout.h"
#include "raster/line.glsl"

// A line by adding its slope, rounded half up; one thread a segment. The sum drifts by no more than
// steps^2 2^-25 pixel. Source: notes 1.9.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { LineArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.segment_count) return;
  const ivec4 segment = args.segments.at[i];
  const uint steps = line_steps(segment), at = args.offsets.at[i];
  precise vec2 increment = vec2(segment.zw - segment.xy) / float(max(steps, 1u));
  precise vec2 offset = vec2(0.0);
  for (uint k = 0u; k <= steps; ++k) {
    args.pixels.at[at + k] = segment.xy + ivec2(floor(offset + 0.5));
    offset += increment;
  }
}
