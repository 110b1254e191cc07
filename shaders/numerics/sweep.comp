#version 460
#include "numerics/layout.h"
#include "numerics/pressure.glsl"
#include "numerics/tiles.glsl"

// One pass over the cells of a pressure system; one thread takes a column of quads along z and keeps
// the planes below and above in registers. Source: notes 9.3 (Jacobi, Gauss-Seidel); row 148: red
// and black cells in turn.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { SweepArgs args; };

/// What a pass does: the numbers of gpu::Sweep.
layout(constant_id = 1) const uint mode = 0u;
const uint smooth_colour = 0u;  ///< Gauss-Seidel, over-relaxed by omega, on one colour in place
const uint first_colour = 1u;   ///< the same from a guess of 0 and omega 1
const uint jacobi = 2u;         ///< result: damped by omega
const uint residual = 3u;       ///< result: rhs - A p; partials: its largest magnitude
const uint apply = 4u;          ///< result: A p; partials: p . A p
const uint measure = 5u;        ///< partials: the residual's largest magnitude

float largest(vec4 v) { return max(max(abs(v.x), abs(v.y)), max(abs(v.z), abs(v.w))); }

/// One quad; returns what it adds to the thread's partial.
float pass_over(uint colour, uint i, uint y, uint z, vec4 own, vec4 here, vec4 below, vec4 above) {
  const uint index = quad_index(args.level, colour, i, y, z);
  const uvec4 words = load_words(args.level, index);
  const vec4 mask = fluid_mask(args.level, words, i, (y + z + colour) & 1u);
  const Stencil s = stencil_of(args.level, words, colour, i, y, z, here, below, above);
  if (mode == apply) {
    const vec4 image = mask * applied(s, own);
    args.result.at[index].cells = image;
    return dot(image, own);
  }
  const vec4 rhs = args.level.rhs.at[index].cells;
  if (mode == smooth_colour) {
    const vec4 value = relaxed(s, rhs, mask);
    args.level.pressure.at[index].cells = args.omega == 1.0 ? value : own + args.omega * (value - own);
    return 0.0;
  }
  if (mode == jacobi) {
    args.result.at[index].cells = own + args.omega * (relaxed(s, rhs, mask) - own);
    return 0.0;
  }
  const vec4 left = mask * (rhs - applied(s, own));
  if (mode == residual) args.result.at[index].cells = left;
  return largest(left);
}

void from_zero(uint i, uint y, uint z) {
  const uint index = quad_index(args.level, args.colour, i, y, z);
  const uvec4 words = load_words(args.level, index);
  const vec4 mask = fluid_mask(args.level, words, i, (y + z + args.colour) & 1u);
  const Stencil s =
      stencil_of(args.level, words, args.colour, i, y, z, vec4(0.0), vec4(0.0), vec4(0.0));
  args.level.pressure.at[index].cells = from_zero_guess(s, args.level.rhs.at[index].cells, mask);
}

float column_of_one_colour(uint i, uint y, uint begin, uint end) {
  const uint other = 1u - args.colour;
  vec4 below = load_quad(args.level, other, i, int(y), int(begin) - 1);
  vec4 here = load_quad(args.level, other, i, int(y), int(begin));
  for (uint z = begin; z < end; ++z) {
    const vec4 above = load_quad(args.level, other, i, int(y), int(z) + 1);
    const vec4 own = args.omega == 1.0
                         ? vec4(0.0)
                         : args.level.pressure.at[quad_index(args.level, args.colour, i, y, z)].cells;
    pass_over(args.colour, i, y, z, own, here, below, above);
    below = here;
    here = above;
  }
  return 0.0;
}

float column_of_both_colours(uint i, uint y, uint begin, uint end) {
  float partial = 0.0;
  vec4 below[2], here[2];
  for (uint c = 0u; c < 2u; ++c) {
    below[c] = load_quad(args.level, c, i, int(y), int(begin) - 1);
    here[c] = load_quad(args.level, c, i, int(y), int(begin));
  }
  for (uint z = begin; z < end; ++z) {
    vec4 above[2];
    for (uint c = 0u; c < 2u; ++c) above[c] = load_quad(args.level, c, i, int(y), int(z) + 1);
    for (uint c = 0u; c < 2u; ++c) {
      const float part = pass_over(c, i, y, z, here[c], here[1u - c], below[1u - c], above[1u - c]);
      partial = mode == apply ? partial + part : max(partial, part);
    }
    below = here;
    here = above;
  }
  return partial;
}

void main() {
  if (args.control.at[0].done != 0u) return;
  const uint row = args.level.row;
  const uint columns = row * args.level.cells.y;
  const uint runs = (args.level.cells.z + args.run - 1u) / args.run;
  const uint id = gl_GlobalInvocationID.x;
  uint i = id % row, y = (id / row) % args.level.cells.y, begin = (id / columns) * args.run;
  uint end = min(begin + args.run, args.level.cells.z);
  if (with_tiles == 0u && id >= columns * runs) return;
  if (with_tiles != 0u) {
    // Four threads a tile, a column each.
    TileTable table = args.tiles.at[0];
    if (id / 4u >= table.groups.at[0]) return;
    const uvec3 corner = tile_side * tile_at(table.list.at[id / 4u]);
    i = corner.x / 8u;
    y = corner.y + id % 4u;
    begin = corner.z;
    end = y < args.level.cells.y ? min(begin + tile_yz, args.level.cells.z) : begin;
  }
  if (mode == first_colour) {
    for (uint z = begin; z < end; ++z) from_zero(i, y, z);
  } else if (mode == smooth_colour) {
    column_of_one_colour(i, y, begin, end);
  } else {
    const float partial = column_of_both_colours(i, y, begin, end);
    if (mode != jacobi) args.partials.at[id] = partial;
  }
}
