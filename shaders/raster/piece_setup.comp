#version 460
#include "raster/clip.glsl"
#include "raster/edge.glsl"

// Clips a triangle where it must be and sets its pieces up; one thread a triangle.
// Source: notes 1.1, 1.4.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { PieceSetupArgs args; };

void main() {
  const uint triangle = gl_GlobalInvocationID.x;
  if (triangle >= args.source.triangle_count) return;
  const uint first = args.offsets.at[triangle];
  const uint last = min(args.offsets.at[triangle + 1u], args.capacity);
  if (first >= last) return;
  const uvec3 corners = args.source.triangles.at[triangle];
  const ClippedRecord polygon = clip_triangle(
      args.source.clip_positions.at[corners.x], args.source.clip_positions.at[corners.y],
      args.source.clip_positions.at[corners.z], args.target.guard_band);
  const uint flags = args.source.flags.at[triangle];
  for (uint i = first; i < last; ++i) {
    const uint k = i - first;  // corners 0, k + 1, k + 2 of the polygon
    const uint element = k + 2u < polygon.count ? args.source.first_element + triangle : 0u;
    TrianglePiece piece = triangle_piece(polygon.position[0], polygon.position[k + 1u],
                                         polygon.position[k + 2u], flags, element, args.target,
                                         args.depth_mode);
    if (element == 0u) piece.element = 0u;
    args.pieces.at[i] = piece;
  }
}
