// The pressure system, four cells of one colour at a time. Source: numerics/layout.h; Harlow & Welch
// 1965 for the stencil; Batty, Bertails & Bridson 2007 for partly open faces.

/// 0: all cells are fluid and all faces inside are open. 1: PressureLevel::words says.
layout(constant_id = 0) const uint with_words = 0u;

uint quad_index(PressureLevel level, uint colour, uint i, uint y, uint z) {
  return ((colour * level.cells.z + z) * level.cells.y + y) * level.row + i;
}

bool is_periodic(PressureLevel level, uint axis) {
  return (level.flags & (pressure_periodic << axis)) != 0u;
}

/// A coordinate one step outside wraps around a periodic axis. False: it is outside.
bool wrap(PressureLevel level, uint axis, inout int at) {
  const int count = int(level.cells[axis]);
  if (is_periodic(level, axis)) at = at < 0 ? at + count : (at >= count ? at - count : at);
  return at >= 0 && at < count;
}

vec4 load_quad(PressureLevel level, uint colour, uint i, int y, int z) {
  if (!wrap(level, 1u, y) || !wrap(level, 2u, z)) return vec4(0.0);
  return level.pressure.at[quad_index(level, colour, i, uint(y), uint(z))].cells;
}

/// The one cell beside a quad, of the other colour: below its first cell where the quad begins at
/// an even x (s = 0), above its last where s = 1.
float load_beside(PressureLevel level, uint colour, uint i, uint s, uint y, uint z) {
  int x = s == 0u ? int(8u * i) - 1 : int(8u * i) + 8;
  if (!wrap(level, 0u, x)) return 0.0;
  const uint row = 4u * quad_index(level, colour, 0u, y, z);
  return ref_float(level.pressure).at[row + uint(x) / 2u];
}

vec4 open_of(uvec4 words, uint side) { return vec4((words >> (5u * side)) & 31u) * (1.0 / 31.0); }

/// Weight of a side's faces: 0 closed, 1 between cells of a periodic axis.
float side_open(PressureLevel level, uint side) {
  if (((level.flags >> side) & 1u) == 0u) return 0.0;
  return is_periodic(level, side / 2u) ? 1.0 : level.open_weight;
}

/// Which of the four cells are there and fluid.
vec4 fluid_mask(PressureLevel level, uvec4 words, uint i, uint s) {
  if (with_words != 0u) return vec4((words >> 30u) & 1u);
  const uvec4 x = 8u * i + s + uvec4(0u, 2u, 4u, 6u);
  return mix(vec4(0.0), vec4(1.0), lessThan(x, uvec4(level.cells.x)));
}

uvec4 load_words(PressureLevel level, uint index) {
  return with_words != 0u ? level.words.at[index].cells : uvec4(0u);
}

/// What a quad's equations are made of: its neighbours and how open the faces to them are, in the
/// order -x +x -y +y -z +z.
struct Stencil {
  vec4 beside[6];
  vec4 open[6];
};

/// @param here, below, above  quads of the other colour at the same place, and at z - 1 and z + 1.
Stencil stencil_of(PressureLevel level, uvec4 words, uint colour, uint i, uint y, uint z, vec4 here,
                   vec4 below, vec4 above) {
  const uint s = (y + z + colour) & 1u;
  const float beside = load_beside(level, 1u - colour, i, s, y, z);
  const uvec4 x = 8u * i + s + uvec4(0u, 2u, 4u, 6u);
  const bvec4 last = equal(x, uvec4(level.cells.x - 1u));
  Stencil result;
  result.beside[0] = s == 0u ? vec4(beside, here.xyz) : here;
  result.beside[1] = s == 0u ? here : vec4(here.yzw, beside);
  if (is_periodic(level, 0u) && s == 1u) {
    const uint first = 4u * quad_index(level, 1u - colour, 0u, y, z);
    result.beside[1] = mix(result.beside[1], vec4(ref_float(level.pressure).at[first]), last);
  }
  result.beside[2] = load_quad(level, 1u - colour, i, int(y) - 1, int(z));
  result.beside[3] = load_quad(level, 1u - colour, i, int(y) + 1, int(z));
  result.beside[4] = below;
  result.beside[5] = above;
  if (with_words != 0u) {
    [[unroll]] for (uint side = 0u; side < 6u; ++side) result.open[side] = open_of(words, side);
    return result;
  }
  result.open[0] = mix(vec4(1.0), vec4(side_open(level, 0u)), equal(x, uvec4(0u)));
  result.open[1] = mix(vec4(1.0), vec4(side_open(level, 1u)), last);
  result.open[2] = vec4(y == 0u ? side_open(level, 2u) : 1.0);
  result.open[3] = vec4(y == level.cells.y - 1u ? side_open(level, 3u) : 1.0);
  result.open[4] = vec4(z == 0u ? side_open(level, 4u) : 1.0);
  result.open[5] = vec4(z == level.cells.z - 1u ? side_open(level, 5u) : 1.0);
  return result;
}

/// The same with all neighbours loaded.
Stencil load_stencil(PressureLevel level, uvec4 words, uint colour, uint i, uint y, uint z) {
  const uint other = 1u - colour;
  return stencil_of(level, words, colour, i, y, z, load_quad(level, other, i, int(y), int(z)),
                    load_quad(level, other, i, int(y), int(z) - 1),
                    load_quad(level, other, i, int(y), int(z) + 1));
}

vec4 diagonal_of(Stencil s) {
  return ((s.open[0] + s.open[1]) + (s.open[2] + s.open[3])) + (s.open[4] + s.open[5]);
}

/// Gauss-Seidel value of the four cells: the neighbours' mean and the right side; 0 where there is
/// no fluid.
vec4 relaxed(Stencil s, vec4 rhs, vec4 mask) {
  vec4 sum = rhs;
  [[unroll]] for (uint side = 0u; side < 6u; ++side) sum += s.open[side] * s.beside[side];
  return mask * sum / max(diagonal_of(s), vec4(1.0 / 31.0));
}

/// The same where all neighbours are 0.
vec4 from_zero_guess(Stencil s, vec4 rhs, vec4 mask) {
  return mask * rhs / max(diagonal_of(s), vec4(1.0 / 31.0));
}

/// A p. Differences come first: they are exact or nearly so, however large the pressure.
vec4 applied(Stencil s, vec4 own) {
  precise vec4 x = s.open[0] * (own - s.beside[0]) + s.open[1] * (own - s.beside[1]);
  precise vec4 y = s.open[2] * (own - s.beside[2]) + s.open[3] * (own - s.beside[3]);
  precise vec4 z = s.open[4] * (own - s.beside[4]) + s.open[5] * (own - s.beside[5]);
  return (x + y) + z;
}

/// rhs - A p of a quad.
vec4 load_residual(PressureLevel level, uint colour, uint i, uint y, uint z) {
  const uint index = quad_index(level, colour, i, y, z);
  const uvec4 words = load_words(level, index);
  const Stencil s = load_stencil(level, words, colour, i, y, z);
  return fluid_mask(level, words, i, (y + z + colour) & 1u) *
         (level.rhs.at[index].cells - applied(s, level.pressure.at[index].cells));
}
