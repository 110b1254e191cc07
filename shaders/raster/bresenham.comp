#version 460
#include "raster/layout.h"
#include "raster/line.glsl"

// A line in any octant, in integers; one thread a segment. Erratum: notes 1.9 neither start the
// error at half a step nor take the long side off it; D = 2 dy - dx, and after a step of the short
// side D -= 2 dx. A tie keeps the short coordinate that is nearer to the beginning.
// Source: Bresenham 1965.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { LineArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.segment_count) return;
  const ivec4 segment = args.segments.at[i];
  const ivec2 d = segment.zw - segment.xy, step = sign(d), size = abs(d);
  const bool steep = size.y > size.x;
  const ivec2 long_step = steep ? ivec2(0, step.y) : ivec2(step.x, 0);
  const ivec2 short_step = steep ? ivec2(step.x, 0) : ivec2(0, step.y);
  const int long_side = steep ? size.y : size.x, short_side = steep ? size.x : size.y;
  ivec2 pixel = segment.xy;
  int error = 2 * short_side - long_side;
  const uint steps = line_steps(segment), at = args.offsets.at[i];
  for (uint k = 0u; k <= steps; ++k) {
    args.pixels.at[at + k] = pixel;
    const bool aside = error > 0;
    pixel += long_step + (aside ? short_step : ivec2(0));
    error += 2 * short_side - (aside ? 2 * long_side : 0);
  }
}
