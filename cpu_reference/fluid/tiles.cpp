#include "cpu_reference/fluid/tiles.h"

namespace parity::cpu {

bool ActivePoints::has_cell(ivec3 cell) const {
  for (int axis = 0; axis < 3; ++axis)
    if (cell[axis] < 0 || cell[axis] >= cells_[axis]) return false;
  return active_[(std::size_t(cell.z) * std::size_t(cells_.y) + std::size_t(cell.y)) *
                     std::size_t(cells_.x) +
                 std::size_t(cell.x)] != 0;
}

void ActivePoints::clear_rest(int axis, Field& field) const {
  for (int z = 0; z < field.size.z; ++z)
    for (int y = 0; y < field.size.y; ++y)
      for (int x = 0; x < field.size.x; ++x)
        if (!has(axis, {x, y, z})) field(x, y, z) = 0;
}

FluidState choose_active(const FluidProblem& problem, const FluidState& state) {
  FluidState result = state;
  result.active = active_cells(problem, state);
  const ActivePoints points(problem.domain, result.active);
  for (int axis = 0; axis < 3; ++axis) points.clear_rest(axis, result.velocity[std::size_t(axis)]);
  for (Field* field : {&result.smoke, &result.temperature, &result.pressure})
    points.clear_rest(-1, *field);
  return result;
}

}  // namespace parity::cpu
