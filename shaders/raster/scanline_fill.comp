#version 460
#include "raster/edge.glsl"
#include "raster/tile.glsl"

// Fills triangles span by span; one thread a row of samples, which no other thread writes to.
// Spans are half open: from the first sample not left of the left edges to the first not left of a
// right edge. Source: notes 1.5.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { ScanlineArgs args; };

/// Where row y crosses an edge that reaches it: the least column whose sample is not left of it. The
/// estimate is within 2^-6 pixel, so the exact edge function moves it by one at most.
int crossing(ivec2 a, ivec2 b, int y, int sample_x) {
  const ivec2 d = b - a;
  const float x = float(a.x) + float(y - a.y) * float(d.x) / float(d.y);
  int column = int(ceil((x - float(sample_x)) / float(subpixel_units))) - 1;
  for (int i = 0; i < 2; ++i) {
    const int side = wide_sign(edge_function(a, b, ivec2(column * subpixel_units + sample_x, y)));
    const bool is_left = d.y < 0 ? side < 0 : side > 0;
    column += is_left ? 1 : 0;
  }
  return column;
}

/// Columns [x, y) of a row.
ivec2 span(TrianglePiece t, int y, int sample_x) {
  const int top = min(min(t.corner[0].y, t.corner[1].y), t.corner[2].y);
  const int bottom = max(max(t.corner[0].y, t.corner[1].y), t.corner[2].y);
  if (t.element == 0u || y < top || y >= bottom) return ivec2(0);
  ivec2 columns = ivec2(0, int(args.target.width));
  for (int i = 0; i < 3; ++i) {
    const ivec2 a = t.corner[i], b = t.corner[i < 2 ? i + 1 : 0];
    if (y < min(a.y, b.y) || y >= max(a.y, b.y)) continue;  // one edge goes up here, one down
    const int column = crossing(a, b, y, sample_x);
    if (b.y < a.y)
      columns.x = max(columns.x, column);
    else
      columns.y = min(columns.y, column);
  }
  return columns;
}

void main() {
  const uint samples = args.target.samples;
  const uint row = gl_GlobalInvocationID.x / samples, s = gl_GlobalInvocationID.x % samples;
  if (row >= args.target.height) return;
  const ivec2 place = sample_place(samples, s) * 16;
  for (uint i = args.first_piece; i < args.last_piece; ++i) {
    const TrianglePiece t = args.pieces.at[i];
    const ivec2 columns = span(t, int(row) * subpixel_units + place.y, place.x);
    for (int x = columns.x; x < columns.y; ++x) {
      const uint at = (row * args.target.width + uint(x)) * samples + s;
      args.counts.at[at] += 1u;
      args.elements.at[at] = t.element;
    }
  }
}
