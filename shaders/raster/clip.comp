#version 460
#include "raster/clip.glsl"

// Clips a triangle by the near and far planes and the guard band; one thread a triangle.
// Source: notes 1.1; Sutherland & Hodgman 1974.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { ClipArgs args; };

void main() {
  const uint triangle = gl_GlobalInvocationID.x;
  if (triangle >= args.source.triangle_count) return;
  const uvec3 corners = args.source.triangles.at[triangle];
  const ClippedRecord polygon = clip_triangle(args.source.clip_positions.at[corners.x],
                                              args.source.clip_positions.at[corners.y],
                                              args.source.clip_positions.at[corners.z],
                                              args.guard_band);
  args.polygons.at[triangle].count = polygon.count;
  for (uint i = 0u; i < polygon.count; ++i) {
    args.polygons.at[triangle].position[i] = polygon.position[i];
    args.polygons.at[triangle].barycentric[i] = polygon.barycentric[i];
  }
}
