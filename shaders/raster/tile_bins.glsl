// Tiles that a triangle may touch: its bounding box, less those outside an edge.
#ifndef PARITY_RASTER_TILE_BINS_GLSL
#define PARITY_RASTER_TILE_BINS_GLSL

#include "raster/edge.glsl"

/// First and last tile, in x and y; empty if last < first.
struct TileBox {
  ivec2 first;
  ivec2 last;
};

TileBox tile_box(TrianglePiece t, RasterTarget target) {
  const ivec2 low = min(min(t.corner[0], t.corner[1]), t.corner[2]);
  const ivec2 high = max(max(t.corner[0], t.corner[1]), t.corner[2]);
  // No sample is further than 8/16 pixel from the centre of its pixel.
  const int reach = target.samples == 1u ? 0 : 128;
  const ivec2 first = max((low - reach + 255) >> 8, ivec2(0));
  const ivec2 last = min((high + reach) >> 8, ivec2(target.width, target.height) - 1);
  if (t.element == 0u || any(lessThan(last, first))) return TileBox(ivec2(0), ivec2(-1));
  return TileBox(first >> 3, last >> 3);
}

/// Whether all samples of the tile are outside an edge for sure. Single precision with its rounding
/// taken off: a tile too much costs time, never a pixel.
bool is_outside_edge(ivec2 a, ivec2 b, vec2 middle, float reach) {
  const vec2 d = vec2(b - a), p = middle - vec2(a);
  precise float positive = d.x * p.y, negative = d.y * p.x;
  precise float slack = reach * (abs(d.x) + abs(d.y)) + 4.8e-7 * (abs(positive) + abs(negative));
  precise float greatest = positive - negative + slack;
  return greatest < 0.0;
}

bool touches_tile(TrianglePiece t, ivec2 tile, uint samples) {
  const vec2 middle = vec2(tile * 2048 + 896);
  const float reach = samples == 1u ? 896.0 : 1024.0;
  return !(is_outside_edge(t.corner[0], t.corner[1], middle, reach) ||
           is_outside_edge(t.corner[1], t.corner[2], middle, reach) ||
           is_outside_edge(t.corner[2], t.corner[0], middle, reach));
}

#endif
