// Homogeneous clipping of a triangle by the near and far planes and a guard band.
// Source: notes 1.1; Sutherland & Hodgman 1974; Blinn & Newell 1978.
#ifndef PARITY_RASTER_CLIP_GLSL
#define PARITY_RASTER_CLIP_GLSL

#include "raster/layout.h"

const uint clip_plane_count = 7u;
const float least_w = 1e-30;  // normal numbers only: some devices flush the others to 0

/// Distance from plane 0..6, in clip units; inside is >= 0.
float clip_distance(vec4 p, uint plane, float guard_band) {
  precise float reach = guard_band * p.w;
  precise float w_distance = p.w - least_w;
  precise float far_distance = p.w - p.z;
  precise vec2 upper = vec2(reach) - p.xy;
  precise vec2 lower = vec2(reach) + p.xy;
  switch (plane) {
    case 0u: return w_distance;
    case 1u: return p.z;
    case 2u: return far_distance;
    case 3u: return lower.x;
    case 4u: return upper.x;
    case 5u: return lower.y;
    default: return upper.y;
  }
}

/// Whether the point is inside all planes; NaN is not.
bool is_inside_clip_volume(vec4 p, float guard_band) {
  precise vec2 reach = vec2(guard_band * p.w);
  return p.w >= least_w && p.z >= 0.0 && p.z <= p.w && abs(p.x) <= reach.x && abs(p.y) <= reach.y;
}

/// Whether all three lie outside one plane of the view volume itself.
bool is_out_of_view(vec4 a, vec4 b, vec4 c) {
  const vec3 w = vec3(a.w, b.w, c.w), x = vec3(a.x, b.x, c.x), y = vec3(a.y, b.y, c.y),
             z = vec3(a.z, b.z, c.z);
  return all(lessThan(x, -w)) || all(greaterThan(x, w)) || all(lessThan(y, -w)) ||
         all(greaterThan(y, w)) || all(lessThan(z, vec3(0.0))) || all(greaterThan(z, w));
}

/// A convex polygon: a triangle, less what planes cut off.
ClippedRecord whole_triangle(vec4 a, vec4 b, vec4 c) {
  ClippedRecord polygon;
  polygon.count = 3u;
  for (int i = 3; i < 10; ++i) polygon.position[i] = a;
  polygon.position[0] = a;
  polygon.position[1] = b;
  polygon.position[2] = c;
  polygon.barycentric[0] = vec3(1, 0, 0);
  polygon.barycentric[1] = vec3(0, 1, 0);
  polygon.barycentric[2] = vec3(0, 0, 1);
  return polygon;
}

/// Appends the point where the segment from `inside` to `outside` meets the plane. Seen from either
/// of two triangles that share the segment it has the same bits.
void append_crossing(inout ClippedRecord to, ClippedRecord from, uint inside, uint outside, float d_in,
                     float d_out) {
  if (to.count >= 10u) return;
  precise float t = d_in / (d_in - d_out);
  precise vec4 position =
      from.position[inside] + t * (from.position[outside] - from.position[inside]);
  precise vec3 barycentric =
      from.barycentric[inside] + t * (from.barycentric[outside] - from.barycentric[inside]);
  to.position[to.count] = position;
  to.barycentric[to.count] = barycentric;
  ++to.count;
}

ClippedRecord clip_by_plane(ClippedRecord polygon, uint plane, float guard_band) {
  ClippedRecord kept;
  kept.count = 0u;
  for (uint i = 0u; i < polygon.count; ++i) {
    const uint next = i + 1u < polygon.count ? i + 1u : 0u;
    const float d = clip_distance(polygon.position[i], plane, guard_band);
    const float d_next = clip_distance(polygon.position[next], plane, guard_band);
    if (d >= 0.0 && kept.count < 10u) {
      kept.position[kept.count] = polygon.position[i];
      kept.barycentric[kept.count] = polygon.barycentric[i];
      ++kept.count;
    }
    if ((d >= 0.0) != (d_next >= 0.0)) {
      if (d >= 0.0)
        append_crossing(kept, polygon, i, next, d, d_next);
      else
        append_crossing(kept, polygon, next, i, d_next, d);
    }
  }
  return kept;
}

/// Whether there is nothing to clip.
bool is_whole(vec4 a, vec4 b, vec4 c, float guard_band) {
  return is_inside_clip_volume(a, guard_band) && is_inside_clip_volume(b, guard_band) &&
         is_inside_clip_volume(c, guard_band);
}

/// count is 0, or 3 to 10.
ClippedRecord clip_triangle(vec4 a, vec4 b, vec4 c, float guard_band) {
  ClippedRecord polygon = whole_triangle(a, b, c);
  // A loop of no turns, not a branch: software devices walk both sides of branches.
  const uint planes = is_whole(a, b, c, guard_band) ? 0u : clip_plane_count;
  for (uint plane = 0u; plane < planes; ++plane)
    polygon = clip_by_plane(polygon, plane, guard_band);
  if (polygon.count < 3u) polygon.count = 0u;
  return polygon;
}

#endif
