#version 460
#include "sampling/area.glsl"

// Adds the signed area of the polygons within each pixel; one thread a pixel. Source: notes 1.8
// (the limit of SSAA); Green's theorem.
layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar, push_constant) uniform Push { AreaCoverageArgs args; };

void main() {
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  if (pixel.x >= args.width || pixel.y >= args.height) return;
  const uint at = pixel.y * args.width + pixel.x;
  float area = args.areas.at[at];
  for (uint i = args.first_edge; i < args.last_edge; ++i)
    area += area_beside(args.edges.at[i].xy - vec2(pixel), args.edges.at[i].zw - vec2(pixel));
  args.areas.at[at] = area;
}
