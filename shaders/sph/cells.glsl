// Cells of a grid as wide as the support, so that all neighbours lie in the 3 x 3 x 3 around a
// point; three in a row along x are one range of the sorted particles. Points outside count to the
// nearest cell, which keeps neighbours neighbours. Source: Green 2010, "Particle Simulation using
// CUDA".

ivec3 cell_of(SphGrid grid, vec3 p) {
  precise const vec3 at = floor((p - grid.low) * grid.inverse_cell);
  const ivec3 last = ivec3(grid.cells) - 1;
  // Twice, as a NaN may pass the first.
  return clamp(ivec3(clamp(at, vec3(0.0), vec3(last))), ivec3(0), last);
}

uint cell_index(SphGrid grid, ivec3 cell) {
  return (uint(cell.z) * grid.cells.y + uint(cell.y)) * grid.cells.x + uint(cell.x);
}

/// Begin and end among the sorted particles of the row of up to three cells around `cell` that is
/// (dy, dz) away; empty beyond the grid.
uvec2 row_range(SphGrid grid, ref_uint starts, ivec3 cell, int dy, int dz) {
  const int y = cell.y + dy;
  const int z = cell.z + dz;
  if (y < 0 || z < 0 || y >= int(grid.cells.y) || z >= int(grid.cells.z)) return uvec2(0u);
  const uint first = cell_index(grid, ivec3(max(cell.x - 1, 0), y, z));
  const uint last = cell_index(grid, ivec3(min(cell.x + 1, int(grid.cells.x) - 1), y, z));
  return uvec2(starts.at[first], starts.at[last + 1u]);
}
