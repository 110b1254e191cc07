#version 460
#include "raster/layout.h"
#include "raster/viewport.glsl"

// Whether a pixel's centre lies inside a polygon: crossings of the ray to the left, counted by parity
// or with sign; one thread a pixel. Rows and columns are half open: a centre on a left or top side is
// inside, on a right or bottom side it is not. Source: notes 1.9.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { PolygonArgs args; };

const uint even_odd = 0u;  // parity::FillRule

/// Sign of a b - c d, each a sum of two floats: exact but for 2^-44 of the greater product.
int product_difference_sign(vec2 a, vec2 b, vec2 c, vec2 d) {
  const vec2 p = exact_product(a.x, b.x), q = exact_product(c.x, d.x);
  precise float low = (p.y - q.y) + ((a.x * b.y + a.y * b.x) - (c.x * d.y + c.y * d.x));
  const vec2 high = exact_sum(p.x, -q.x);
  precise float total = high.x + (high.y + low);
  return total > 0.0 ? 1 : (total < 0.0 ? -1 : 0);
}

/// Which side of the edge the point is on: 1 right of it, -1 left, 0 on it (y down, edge going down).
int side(vec2 top, vec2 bottom, vec2 point) {
  return product_difference_sign(exact_sum(point.x, -top.x), exact_sum(bottom.y, -top.y),
                                 exact_sum(bottom.x, -top.x), exact_sum(point.y, -top.y));
}

int winding(vec2 centre) {
  int sum = 0;
  for (uint i = 0u; i < args.edge_count; ++i) {
    const vec4 edge = args.edges.at[i];
    const bool down = edge.y <= edge.w;
    const vec2 top = down ? edge.xy : edge.zw, bottom = down ? edge.zw : edge.xy;
    const bool crosses_row = top.y <= centre.y && centre.y < bottom.y;
    if (crosses_row && side(top, bottom, centre) >= 0) sum += down ? 1 : -1;
  }
  return sum;
}

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.width * args.height) return;
  const int sum = winding(vec2(i % args.width, i / args.width) + 0.5);
  args.inside.at[i] = args.rule == even_odd ? uint(sum & 1) : uint(sum != 0);
}
