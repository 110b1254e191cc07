// Cells of a grid half as wide as the support, so that all neighbours lie in the 5 x 5 rows along x
// around a point; of each row, the cells within the support are one range of the sorted particles.
// Points outside count to the nearest cell, which keeps neighbours neighbours. Source: Green 2010,
// "Particle Simulation using CUDA", with finer cells.

/// Rows to look at on either side along y.
const int row_reach = 2;

ivec3 cell_of(SphGrid grid, vec3 p) {
  precise const vec3 at = floor((p - grid.low) * grid.inverse_cell);
  const ivec3 last = ivec3(grid.cells) - 1;
  // Twice, as a NaN may pass the first.
  return clamp(ivec3(clamp(at, vec3(0.0), vec3(last))), ivec3(0), last);
}

uint cell_index(SphGrid grid, ivec3 cell) {
  return (uint(cell.z) * grid.cells.y + uint(cell.y)) * grid.cells.x + uint(cell.x);
}

/// How far a point is at least from a row `step` away, in cells; 0 for the outermost rows, whose
/// points may lie anywhere beyond. `along`: the point's coordinate in cells.
float row_distance(float along, int cell, int step, uint cells) {
  const int row = cell + step;
  if (step == 0 || row <= 0 || row >= int(cells) - 1) return 0.0;
  const float apart = step < 0 ? along - float(row + 1) : float(row) - along;
  return max(apart, 0.0);
}

uint cell_along_x(SphGrid grid, float x) {
  precise const float at = floor((x - grid.low.x) * grid.inverse_cell.x);
  const int last = int(grid.cells.x) - 1;
  return uint(clamp(int(clamp(at, 0.0, float(last))), 0, last));
}

/// First and last cell of the part of a row that may be within the support; the row is (dy, dz) away
/// from the point's cell. x > y: none. A thousandth of the support is added against rounding.
uvec2 row_cells(SphGrid grid, vec3 p, ivec3 cell, int dy, int dz) {
  const int y = cell.y + dy;
  const int z = cell.z + dz;
  if (y < 0 || z < 0 || y >= int(grid.cells.y) || z >= int(grid.cells.z)) return uvec2(1u, 0u);
  const vec3 at = (p - grid.low) * grid.inverse_cell;
  const float a = row_distance(at.y, cell.y, dy, grid.cells.y);
  const float b = row_distance(at.z, cell.z, dz, grid.cells.z);
  const float square = 1.002 - 0.25 * (a * a + b * b);
  if (!(square > 0.0)) return uvec2(1u, 0u);
  const float reach = (sqrt(square) + 0.001) * grid.support;
  const uint row = (uint(z) * grid.cells.y + uint(y)) * grid.cells.x;
  return row + uvec2(cell_along_x(grid, p.x - reach), cell_along_x(grid, p.x + reach));
}

/// Begin and end among the sorted particles.
uvec2 row_range(SphGrid grid, ref_uint starts, vec3 p, ivec3 cell, int dy, int dz) {
  const uvec2 cells = row_cells(grid, p, cell, dy, dz);
  if (cells.x > cells.y) return uvec2(0u);
  return uvec2(starts.at[cells.x], starts.at[cells.y + 1u]);
}
