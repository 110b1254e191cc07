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
  precise float sum = args.source.clip_positions.at[corners.x].w +
                      args.source.clip_positions.at[corners.y].w +
                      args.source.clip_positions.at[corners.z].w;
  precise float mean = sum / 3.0;
  args.keys.at[triangle] = mean;
}
