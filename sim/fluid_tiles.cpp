#include <algorithm>
#include <cmath>

#include "sim/fluid.h"

namespace parity {
namespace {

/// Calls visit(point) for every point of a box, x fastest.
template <typename Visit>
void for_points(ivec3 size, const Visit& visit) {
  for (int z = 0; z < size.z; ++z)
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) visit(ivec3(x, y, z));
}

bool is_in_a_source(const FluidProblem& problem, ivec3 cell) {
  const dvec3 position = point_position(problem.domain, -1, cell);
  // A cell more: rounding must not decide.
  return std::ranges::any_of(problem.sources, [&](const FluidSource& source) {
    return glm::distance(position, source.center) <= source.radius + problem.domain.spacing;
  });
}

bool is_busy(const FluidProblem& problem, const FluidState& state, ivec3 cell) {
  const FluidParameters& p = problem.parameters;
  if (is_in_a_source(problem, cell)) return true;
  if (state.smoke(cell) > p.busy_smoke || std::abs(state.temperature(cell)) > p.busy_heat)
    return true;
  for (int axis = 0; axis < 3; ++axis)
    for (const ivec3 face : {cell, cell + axis_step(axis)})
      if (std::abs(state.velocity[std::size_t(axis)](face)) > p.busy_speed) return true;
  return false;
}

/// 1 in busy cells.
Field busy_cells(const FluidProblem& problem, const FluidState& state) {
  const FluidDomain& domain = problem.domain;
  Field busy(domain.cells);
  if (is_liquid(problem.parameters.method)) {
    for (const vec3 p : state.particles.positions) busy(particle_cell(domain, p)) = 1;
    return busy;
  }
  for_points(domain.cells, [&](ivec3 cell) { busy(cell) = is_busy(problem, state, cell) ? 1 : 0; });
  return busy;
}

/// Marks the tiles that lie within a margin of a cell.
void mark_tiles(Field& tiles, ivec3 cell, int margin) {
  const ivec3 low = glm::max((cell - margin) / fluid_tile, ivec3(0));
  const ivec3 high = glm::min((cell + margin) / fluid_tile, tiles.size - 1);
  for_points(high - low + 1, [&](ivec3 step) { tiles(low + step) = 1; });
}

}  // namespace

int active_margin(const FluidParameters& parameters) {
  return int(std::ceil(parameters.courant)) + (is_liquid(parameters.method) ? 1 : 0);
}

std::vector<std::uint8_t> active_cells(const FluidProblem& problem, const FluidState& state) {
  const ivec3 cells = problem.domain.cells;
  const Field busy = busy_cells(problem, state);
  Field tiles((cells + fluid_tile - 1) / fluid_tile);
  for_points(cells, [&](ivec3 cell) {
    if (busy(cell) > 0) mark_tiles(tiles, cell, active_margin(problem.parameters));
  });
  std::vector<std::uint8_t> active;
  for_points(cells, [&](ivec3 cell) { active.push_back(tiles(cell / fluid_tile) > 0 ? 1 : 0); });
  return active;
}

std::vector<std::uint32_t> source_rows(const FluidProblem& problem) {
  const ivec3 cells = problem.domain.cells;
  const Field tiles((cells + fluid_tile - 1) / fluid_tile);
  std::vector<std::uint32_t> rows(4 * tiles.values.size(), 0);
  for_points(cells, [&](ivec3 cell) {
    if (!is_in_a_source(problem, cell)) return;
    const ivec3 tile = cell / fluid_tile, in = cell % fluid_tile;
    rows[4 * tiles.index(tile.x, tile.y, tile.z) + std::size_t(in.z)] |=
        1u << (in.x + fluid_tile.x * in.y);
  });
  return rows;
}

}  // namespace parity
