// Triangles in fixed point and their edge functions. Source: notes 1.4, 1.5; Vulkan 1.3, "Basic
// Polygon Rasterization".
//
// Coordinates are 1/256 pixel from the centre of pixel (0, 0), y down. A guard band keeps any two of
// them within 2^23 (32768 pixels), so an edge function needs 47 bits and its slope 24.
#ifndef PARITY_RASTER_EDGE_GLSL
#define PARITY_RASTER_EDGE_GLSL

#include "raster/layout.h"
#include "raster/viewport.glsl"
#include "raster/wide.glsl"

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

/// Three corners in clip space, set up for a target; turned so that the area is positive.
TrianglePiece triangle_piece(vec4 a, vec4 b, vec4 c, uint flags, uint element, RasterTarget target,
                             uint depth_mode) {
  const vec2 size = vec2(target.width, target.height);
  TrianglePiece piece;
  piece.corner[0] = snap(a, size, target.samples, target.snapping);
  piece.corner[1] = snap(b, size, target.samples, target.snapping);
  piece.corner[2] = snap(c, size, target.samples, target.snapping);
  const vec3 w = vec3(a.w, b.w, c.w);
  precise vec3 depth = (depth_mode == 2u ? vec3(1.0) : vec3(a.z, b.z, c.z)) / w;
  piece.depth = depth;
  const int area = wide_sign(edge_function(piece.corner[0], piece.corner[1], piece.corner[2]));
  if (area < 0) {
    const ivec2 corner = piece.corner[1];
    piece.corner[1] = piece.corner[2];
    piece.corner[2] = corner;
    piece.depth = piece.depth.xzy;
  }
  piece.element = element;
  if ((flags & triangle_unseen) != 0u) piece.element |= element_unseen;
  if (area == 0 || is_culled(area > 0, flags)) piece.element = 0u;
  return piece;
}

#endif
