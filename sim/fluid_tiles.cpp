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

ivec3 parts(ivec3 cells, int side) { return (cells + side - 1) / side; }

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

/// 1 in blocks that hold a busy cell.
Field busy_blocks(const FluidProblem& problem, const FluidState& state) {
  const FluidDomain& domain = problem.domain;
  Field blocks(parts(domain.cells, fluid_block));
  if (is_liquid(problem.parameters.method)) {
    for (const vec3 p : state.particles.positions)
      blocks(particle_cell(domain, p) / fluid_block) = 1;
    return blocks;
  }
  for_points(domain.cells, [&](ivec3 cell) {
    if (is_busy(problem, state, cell)) blocks(cell / fluid_block) = 1;
  });
  return blocks;
}

}  // namespace

std::vector<std::uint8_t> active_cells(const FluidProblem& problem, const FluidState& state) {
  const ivec3 cells = problem.domain.cells;
  const Field blocks = busy_blocks(problem, state);
  Field tiles(parts(cells, fluid_tile));
  for_points(tiles.size, [&](ivec3 tile) {
    const ivec3 low = glm::max(2 * tile - 1, ivec3(0));
    const ivec3 high = glm::min(2 * tile + 2, blocks.size - 1);
    for_points(high - low + 1,
               [&](ivec3 step) { tiles(tile) = std::max(tiles(tile), blocks(low + step)); });
  });
  std::vector<std::uint8_t> active;
  for_points(cells, [&](ivec3 cell) { active.push_back(tiles(cell / fluid_tile) > 0 ? 1 : 0); });
  return active;
}

std::vector<std::uint32_t> source_blocks(const FluidProblem& problem) {
  const Field tiles(parts(problem.domain.cells, fluid_tile));
  std::vector<std::uint32_t> blocks(8 * tiles.values.size(), 0);
  for_points(problem.domain.cells, [&](ivec3 cell) {
    if (!is_in_a_source(problem, cell)) return;
    const ivec3 tile = cell / fluid_tile, odd = cell / fluid_block % 2;
    blocks[8 * tiles.index(tile.x, tile.y, tile.z) + std::size_t(odd.x + 2 * odd.y + 4 * odd.z)] =
        1;
  });
  return blocks;
}

}  // namespace parity
