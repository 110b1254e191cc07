#version 460
#include "raster/clip.glsl"

// Pieces to keep room for: none out of view, one for a triangle that needs no clipping, else as many
// as clipping can leave; one thread a triangle, and one more that ends the prefix sum.
// Source: notes 1.1.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { PieceCountArgs args; };

const uint most_pieces = 8u;

void main() {
  const uint triangle = gl_GlobalInvocationID.x;
  if (triangle > args.source.triangle_count) return;
  uint count = 0u;
  if (triangle < args.source.triangle_count) {
    const uvec3 corners = args.source.triangles.at[triangle];
    const vec4 a = args.source.clip_positions.at[corners.x];
    const vec4 b = args.source.clip_positions.at[corners.y];
    const vec4 c = args.source.clip_positions.at[corners.z];
    const bool whole = is_whole(a, b, c, args.target.guard_band);
    count = is_out_of_view(a, b, c) ? 0u : (whole ? 1u : most_pieces);
  }
  args.counts.at[triangle] = count;
}
