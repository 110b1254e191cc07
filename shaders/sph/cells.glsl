// Cells of a grid half as wide as the support, or as wide along y and z, so that all neighbours lie in
// the 5 x 5 or 3 x 3 rows along x around a point; of each row, the cells within the support are one
// range of the sorted particles. Points outside count to the nearest cell, which keeps neighbours
// neighbours. Source: Green 2010, "Particle Simulation using CUDA", with finer cells.

ivec3 cell_of(SphGrid grid, vec3 p) {
  precise const vec3 at = floor((p - grid.low) * grid.inverse_cell);
  const ivec3 last = ivec3(grid.cells) - 1;
  // Twice, as a NaN may pass the first.
  return clamp(ivec3(clamp(at, vec3(0.0), vec3(last))), ivec3(0), last);
}

uint cell_index(SphGrid grid, ivec3 cell) {
  return (uint(cell.z) * grid.cells.y + uint(cell.y)) * grid.cells.x + uint(cell.x);
}

/// Where a point is, in cells from the grid's corner.
vec3 place_in_cells(SphGrid grid, vec3 p) { return (p - grid.low) * grid.inverse_cell; }

/// Least square of the distance, in supports, from a point to the rows that are `step` rows of one
/// `reach`-th of a support away; 0 for the outermost rows, whose points may lie anywhere beyond, and
/// out of reach where there are none. `along`: the point's coordinate in cells.
float row_distance(float along, int cell, int step, uint cells, int reach) {
  const int row = cell + step;
  const int last = int(cells) - 1;
  if (row < 0 || row > last) return 2.0;
  if (step == 0 || row == 0 || row == last) return 0.0;
  const float apart = max(step < 0 ? along - float(row + 1) : float(row) - along, 0.0) / float(reach);
  return apart * apart;
}

/// What is left of the squared support, in supports, for a row after its distances; a little is added
/// against rounding. Not positive: no point of the row is within the support.
const float whole_support = 1.002;

/// Begin and end, among the sorted particles, of the part of a row that may be within the support.
/// `x`: the point's coordinate in cells; `row`: number of the row; `left`: as above, positive.
uvec2 row_range(SphGrid grid, ref_uint starts, float x, int row, float left) {
  const float reach = 2.0 * (sqrt(left) + 0.001);
  const int last = int(grid.cells.x) - 1;
  const vec2 ends = clamp(vec2(x - reach, x + reach), 0.0, float(last));
  // Twice, as a NaN may pass the first.
  const ivec2 part = clamp(ivec2(ends), 0, last) + row * int(grid.cells.x);
  return uvec2(starts.at[part.x], starts.at[part.y + 1]);
}
