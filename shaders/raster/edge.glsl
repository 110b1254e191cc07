// Triangles in fixed point and their edge functions. Source: notes 1.4, 1.5; Vulkan 1.3, "Basic
// Polygon Rasterization".
//
// Coordinates are 1/256 pixel from the centre of pixel (0, 0), y down. A guard band keeps any two of
// them within 2^23 (32768 pixels), so an edge function needs 47 bits and its slope 24.
#ifndef PARITY_RASTER_EDGE_GLSL
#define PARITY_RASTER_EDGE_GLSL

#include "raster/layout.h"
#include "raster/clip.glsl"
#include "raster/viewport.glsl"
#include "raster/wide.glsl"

/// Corners turned so that the area is positive (clockwise on the screen).
struct FixedTriangle {
  ivec2 corner[3];
  vec3 depth;      // z/w of the corners
  vec3 inverse_w;  // 1/w of the corners
  uint usable;     // 0: culled, of no area, or no such piece
};

/// E(p) of the edge from a to b: positive on the inner side. Erratum: notes 1.4 add b_y - a_y for a
/// step in x; the increment is -(b_y - a_y).
Wide edge_function(ivec2 a, ivec2 b, ivec2 p) {
  return wide_difference(wide_product(b.x - a.x, p.y - a.y), wide_product(b.y - a.y, p.x - a.x));
}

/// 1 where samples on the edge do not belong to the triangle: neither left nor top.
int edge_bias(ivec2 a, ivec2 b) {
  const ivec2 d = b - a;
  return d.y < 0 || (d.y == 0 && d.x > 0) ? 0 : 1;
}

/// floor((E(p) - bias) / 16), clamped to 31 bits: what a tile adds its steps of 1/16 pixel to. As E
/// changes by a multiple of 16 from step to step, the sign stays exact.
int edge_at(ivec2 a, ivec2 b, ivec2 p) {
  const Wide e = edge_function(a, b, p);
  return wide_sixteenth(wide_difference(e, Wide(0, uint(edge_bias(a, b)))));
}

bool is_culled(bool clockwise, uint flags) {
  const bool front = clockwise == ((flags & triangle_mirrored) != 0u);
  return (flags & (front ? triangle_cull_front : triangle_cull_back)) != 0u;
}

/// Three corners in clip space, set up for a target.
FixedTriangle fixed_triangle(vec4 a, vec4 b, vec4 c, uint flags, RasterTarget target) {
  const vec2 size = vec2(target.width, target.height);
  FixedTriangle t;
  t.corner[0] = snap(a, size, target.samples, target.snapping);
  t.corner[1] = snap(b, size, target.samples, target.snapping);
  t.corner[2] = snap(c, size, target.samples, target.snapping);
  precise vec3 inverse_w = vec3(1.0) / vec3(a.w, b.w, c.w);
  precise vec3 depth = vec3(a.z, b.z, c.z) / vec3(a.w, b.w, c.w);
  t.inverse_w = inverse_w;
  t.depth = depth;
  const int area = wide_sign(edge_function(t.corner[0], t.corner[1], t.corner[2]));
  if (area < 0) {
    const ivec2 corner = t.corner[1];
    t.corner[1] = t.corner[2];
    t.corner[2] = corner;
    t.depth = t.depth.xzy;
    t.inverse_w = t.inverse_w.xzy;
  }
  t.usable = area != 0 && !is_culled(area > 0, flags) ? 1u : 0u;
  return t;
}

/// Piece k of what clipping leaves of a triangle (corners 0, k + 1, k + 2 of the polygon).
FixedTriangle fixed_piece(ClippedRecord polygon, uint piece, uint flags, RasterTarget target) {
  return fixed_triangle(polygon.position[0], polygon.position[piece + 1u],
                        polygon.position[piece + 2u], flags, target);
}

/// Pieces of a triangle of the source; their polygon is left in `polygon`.
uint load_pieces(TriangleSource source, RasterTarget target, uint triangle,
                 out ClippedRecord polygon) {
  const uvec3 corners = source.triangles.at[triangle];
  const vec4 a = source.clip_positions.at[corners.x];
  const vec4 b = source.clip_positions.at[corners.y];
  const vec4 c = source.clip_positions.at[corners.z];
  polygon = clip_triangle(a, b, c, target.guard_band);
  return is_out_of_view(a, b, c) || polygon.count == 0u ? 0u : polygon.count - 2u;
}

#endif
