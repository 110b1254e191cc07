// Between a grid and the one with cells twice as wide. Needs numerics/pressure.glsl.

/// 2 along axes that are halved.
uvec3 cells_per_coarse(PressureLevel fine, PressureLevel coarse) {
  return uvec3(fine.cells.x > coarse.cells.x ? 2u : 1u, fine.cells.y > coarse.cells.y ? 2u : 1u,
               fine.cells.z > coarse.cells.z ? 2u : 1u);
}

/// Sum of the red residuals of four coarse cells X to X + 3; black ones are 0 after a black sweep.
/// A quad of red cells of a fine row lies in the coarse cells 4 i to 4 i + 3, one in each.
vec4 restricted_residual(PressureLevel fine, PressureLevel coarse, uint i, uint y, uint z) {
  const uvec3 per = cells_per_coarse(fine, coarse);
  vec4 sum = vec4(0.0);
  for (uint k = 0u; k < per.z * per.y; ++k) {
    const uint fy = per.y * y + k % per.y, fz = per.z * z + k / per.y;
    if (fy < fine.cells.y && fz < fine.cells.z) sum += load_residual(fine, 0u, i, fy, fz);
  }
  // A cell's equation is that of its volume: h^2 of the coarse grid is 4 of the fine one, and the
  // mean of the children is taken.
  return sum * (4.0 / float(per.x * per.y * per.z));
}

/// The same for the right side itself, both colours.
vec4 restricted_rhs(PressureLevel fine, PressureLevel coarse, uint i, uint y, uint z) {
  const uvec3 per = cells_per_coarse(fine, coarse);
  vec4 sum = vec4(0.0);
  for (uint k = 0u; k < per.z * per.y; ++k) {
    const uint fy = per.y * y + k % per.y, fz = per.z * z + k / per.y;
    if (fy >= fine.cells.y || fz >= fine.cells.z) continue;
    for (uint c = 0u; c < 2u; ++c) sum += fine.rhs.at[quad_index(fine, c, i, fy, fz)].cells;
  }
  return sum * (4.0 / float(per.x * per.y * per.z));
}

/// Four consecutive coarse cells from X = 4 i on, one row: two of either colour.
void store_row(PressureLevel coarse, uint i, uint y, uint z, vec4 values) {
  const uint even_colour = (y + z) & 1u;  // of the cells with even X: X + y + z even is red
  const uint even = 2u * quad_index(coarse, even_colour, 0u, y, z) + i;
  const uint odd = 2u * quad_index(coarse, 1u - even_colour, 0u, y, z) + i;
  ref_PressurePair(coarse.rhs).at[even].cells = values.xz;
  ref_PressurePair(coarse.rhs).at[odd].cells = values.yw;
}

vec4 load_row(PressureLevel coarse, uint i, uint y, uint z) {
  const uint even_colour = (y + z) & 1u;
  const vec2 even =
      ref_PressurePair(coarse.pressure).at[2u * quad_index(coarse, even_colour, 0u, y, z) + i].cells;
  const vec2 odd =
      ref_PressurePair(coarse.pressure).at[2u * quad_index(coarse, 1u - even_colour, 0u, y, z) + i].cells;
  return vec4(even.x, odd.x, even.y, odd.y);
}

float load_cell(PressureLevel coarse, int x, uint y, uint z) {
  const uint colour = (uint(x) + y + z) & 1u;
  return ref_float(coarse.pressure).at[4u * quad_index(coarse, colour, 0u, y, z) + uint(x) / 2u];
}

/// The neighbouring row of coarse values towards `step` along y or z; the row itself where there is
/// none.
vec4 row_beside(PressureLevel coarse, uint i, uvec3 at, uint axis, int step, vec4 own) {
  int there = int(at[axis]) + step;
  const uint side = 2u * axis + (step > 0 ? 1u : 0u);
  if (!wrap(coarse, axis, there)) return own * (1.0 - side_open(coarse, side));
  at[axis] = uint(there);
  return load_row(coarse, i, at.y, at.z);
}

/// Where no flow passes between a coarse cell and its neighbour, the cell's own value stands for
/// the neighbour's.
vec4 closed_to_own(PressureLevel coarse, uint i, uint y, uint z, uint side, vec4 beside, vec4 own) {
  if (with_words == 0u) return beside;
  const uint even_colour = (y + z) & 1u;
  vec4 result = beside;
  for (uint k = 0u; k < 4u; ++k) {
    const uint colour = (k & 1u) == 0u ? even_colour : 1u - even_colour;
    const uint word =
        ref_uint(coarse.words).at[4u * quad_index(coarse, colour, 0u, y, z) + 2u * i + k / 2u];
    if (((word >> (5u * side)) & 31u) == 0u) result[k] = own[k];
  }
  return result;
}

/// Linear interpolation to the fine cells of one quad from their coarse cell and its neighbours
/// towards the fine cell: a quarter of the way to each.
vec4 prolonged(PressureLevel fine, PressureLevel coarse, uint colour, uint i, uint y, uint z) {
  const uvec3 per = cells_per_coarse(fine, coarse);
  const uvec3 at = uvec3(0u, y / per.y, z / per.z);
  const uint s = (y + z + colour) & 1u;  // x parity of the fine cells: towards which side they lie
  const vec4 own = load_row(coarse, i, at.y, at.z);
  int x = s == 0u ? int(4u * i) - 1 : int(4u * i) + 4;
  const uint side = s;
  float end;
  if (wrap(coarse, 0u, x)) {
    end = load_cell(coarse, x, at.y, at.z);
  } else {
    end = (s == 0u ? own.x : own.w) * (1.0 - side_open(coarse, side));
  }
  vec4 beside = s == 0u ? vec4(end, own.xyz) : vec4(own.yzw, end);
  // The last coarse cell of a row that ends inside the quad has its wall there.
  if (s == 1u) {
    const uvec4 cell = 4u * i + uvec4(0u, 1u, 2u, 3u);
    const vec4 wall = is_periodic(coarse, 0u) ? vec4(load_cell(coarse, 0, at.y, at.z))
                                              : own * (1.0 - side_open(coarse, 1u));
    beside = mix(beside, wall, equal(cell, uvec4(coarse.cells.x - 1u)));
  }
  vec4 change = closed_to_own(coarse, i, at.y, at.z, side, beside, own) - own;
  if (per.y == 2u) {
    const int step = (y & 1u) == 0u ? -1 : 1;
    const vec4 row = row_beside(coarse, i, at, 1u, step, own);
    change += closed_to_own(coarse, i, at.y, at.z, step > 0 ? 3u : 2u, row, own) - own;
  }
  if (per.z == 2u) {
    const int step = (z & 1u) == 0u ? -1 : 1;
    const vec4 row = row_beside(coarse, i, at, 2u, step, own);
    change += closed_to_own(coarse, i, at.y, at.z, step > 0 ? 5u : 4u, row, own) - own;
  }
  return own + 0.25 * change;
}

/// Adds the coarse grid's correction to a quad, or puts it there.
void prolong_quad(PressureLevel fine, PressureLevel coarse, uint colour, uint i, uint y, uint z,
                  bool add) {
  const uint index = quad_index(fine, colour, i, y, z);
  const vec4 mask = fluid_mask(fine, load_words(fine, index), i, (y + z + colour) & 1u);
  const vec4 value = mask * prolonged(fine, coarse, colour, i, y, z);
  fine.pressure.at[index].cells = add ? fine.pressure.at[index].cells + value : value;
}
