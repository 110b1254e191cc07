#version 460
#include "raster/edge.glsl"
#include "raster/tile.glsl"

// Sets up one piece for one tile: exact edge functions at the middle of the tile, and the plane of
// its depth; one thread a pair. Source: notes 1.3, 1.4.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { TileSetupArgs args; };

/// Depth as value at the middle and steps of 1/16 pixel: affine in the window. Erratum: notes 1.3
/// correct depth for perspective; z/w is affine already.
vec3 depth_plane(TrianglePiece t, ivec2 middle) {
  const float inverse_area =
      1.0 / wide_float(edge_function(t.corner[0], t.corner[1], t.corner[2]));
  const vec2 edge20 = vec2(t.corner[0] - t.corner[2]), edge01 = vec2(t.corner[1] - t.corner[0]);
  const float b1 = wide_float(edge_function(t.corner[2], t.corner[0], middle));
  const float b2 = wide_float(edge_function(t.corner[0], t.corner[1], middle));
  const float z10 = t.depth.y - t.depth.x, z20 = t.depth.z - t.depth.x;
  precise vec3 plane = vec3(t.depth.x + (b1 * z10 + b2 * z20) * inverse_area,
                            -16.0 * (edge20.y * z10 + edge01.y * z20) * inverse_area,
                            16.0 * (edge20.x * z10 + edge01.x * z20) * inverse_area);
  return plane;
}

void main() {
  const uint pair = gl_GlobalInvocationID.x;
  if (pair >= min(args.pair_count.at[0], args.capacity)) return;
  const TrianglePiece t = args.pieces.at[args.values.at[pair]];
  const ivec2 middle = tile_middle(args.keys.at[pair], args.tiles_x);
  const ivec2 a = t.corner[0], b = t.corner[1], c = t.corner[2];

  TileTriangle result;
  result.edge = ivec3(edge_at(b, c, middle), edge_at(c, a, middle), edge_at(a, b, middle));
  result.edge_x = ivec3(b.y - c.y, c.y - a.y, a.y - b.y);
  result.edge_y = ivec3(c.x - b.x, a.x - c.x, b.x - a.x);
  result.depth = depth_plane(t, middle);
  result.element = t.element;
  args.triangles.at[pair] = result;
}
