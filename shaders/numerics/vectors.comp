#version 460
#include "numerics/layout.h"
#include "numerics/tiles.glsl"

// The vector operations of conjugate gradients; one thread takes `run` quads in
// a row, or a plane of a tile. Source: notes
// 9.3; Hestenes & Stiefel 1952.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { VectorArgs args; };

layout(constant_id = 1) const uint mode = 0u;
const uint dots = 0u;           ///< partials: z . r and z . q
const uint direction = 1u;      ///< d = z + beta d
const uint advance = 2u;        ///< x + x_low += alpha d, r -= alpha q; partials: the largest |r|
const uint sums = 3u;           ///< partials: sum of r over fluid cells, and their number
const uint subtract_mean = 4u;  ///< r -= mean in fluid cells

vec4 fluid(uint at) { return vec4((args.words.at[at].cells >> 30u) & 1u); }

/// a in two parts of at most 12 bits.
void split(vec4 a, out vec4 high, out vec4 low) {
  precise vec4 scaled = 4097.0 * a;
  precise vec4 front = scaled - (scaled - a);
  precise vec4 back = a - front;
  high = front;
  low = back;
}

/// x + x_low += alpha d without rounding the product: differences of the pressure matter that are
/// smaller than its last place. Source: Dekker 1971; Knuth 1969, 4.2.2.
void add_exactly(uint k, float alpha) {
  const vec4 d = args.d.at[k].cells, a = vec4(alpha);
  vec4 a_high, a_low, d_high, d_low;
  split(a, a_high, a_low);
  split(d, d_high, d_low);
  precise vec4 product = a * d;
  precise vec4 error = ((a_high * d_high - product) + a_high * d_low + a_low * d_high) + a_low * d_low;
  const vec4 high = args.x.at[k].cells;
  precise vec4 sum = high + product;
  precise vec4 part = sum - high;
  precise vec4 rest = (high - (sum - part)) + (product - part);
  precise vec4 low = args.x_low.at[k].cells + (rest + error);
  precise vec4 top = sum + low;
  precise vec4 remainder = low - (top - sum);
  args.x.at[k].cells = top;
  args.x_low.at[k].cells = remainder;
}

/// Quad k; what it adds to the partials goes to a and b.
void work_on(SolverControl control, uint k, inout vec4 a, inout vec4 b) {
  if (mode == dots) {
    const vec4 z = args.z.at[k].cells;
    a += z * args.r.at[k].cells;
    b += z * args.q.at[k].cells;
  } else if (mode == direction) {
    args.d.at[k].cells = args.z.at[k].cells + control.beta * args.d.at[k].cells;
  } else if (mode == advance) {
    add_exactly(k, control.alpha);
    const vec4 r = args.r.at[k].cells - control.alpha * args.q.at[k].cells;
    args.r.at[k].cells = r;
    a = max(a, abs(r));
  } else if (mode == sums) {
    const vec4 mask = fluid(k);
    a += mask * args.r.at[k].cells;
    b += mask;
  } else {
    args.r.at[k].cells -= control.mean * fluid(k);
  }
}

void main() {
  const SolverControl control = args.control.at[0];
  if (control.done != 0u) return;
  const uint id = gl_GlobalInvocationID.x;
  vec4 a = vec4(0.0), b = vec4(0.0);
  if (with_tiles == 0u) {
    const uint begin = id * args.run, end = min(begin + args.run, args.quads);
    if (begin >= args.quads) return;
    for (uint k = begin; k < end; ++k) work_on(control, k, a, b);
  } else {
    // Four threads a tile, one plane of it each.
    TileTable table = args.tiles.at[0];
    if (id / 4u >= table.groups.at[0]) return;
    const uvec3 tile = tile_at(table.list.at[id / 4u]);
    const uint y = tile_yz * tile.y, z = tile_yz * tile.z + id % 4u;
    for (uint k = 0u; k < 8u && z < args.cells.z; ++k)
      if (y + k % 4u < args.cells.y)
        work_on(control, ((k / 4u * args.cells.z + z) * args.cells.y + y + k % 4u) * args.row + tile.x, a, b);
  }
  if (mode == direction || mode == subtract_mean) return;
  if (mode == advance) {
    args.partials.at[id] = max(max(a.x, a.y), max(a.z, a.w));
    return;
  }
  args.partials.at[2u * id] = (a.x + a.y) + (a.z + a.w);
  args.partials.at[2u * id + 1u] = (b.x + b.y) + (b.z + b.w);
}
