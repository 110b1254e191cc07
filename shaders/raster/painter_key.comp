#version 460
#include "raster/layout.h"

// How far a triangle is: the mean of its corners' w, the depth before the eye; one thread a
// triangle. Source: notes 1.7.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { PainterKeyArgs args; };

void main() {
  const uint triangle = gl_GlobalInvocationID.x;
  if (triangle >= args.source.triangle_count) return;
  const uvec3 corners = args.source.triangles.at[triangle];
  const vec4 a = args.source.clip_positions.at[corners.x];
  const vec4 b = args.source.clip_positions.at[corners.y];
  const vec4 c = args.source.clip_positions.at[corners.z];
  precise float sum = a.w + b.w + c.w;
  precise float mean = sum / 3.0;
  args.keys.at[triangle] = mean;
}
