#pragma once

#include "sim/fluid.h"

namespace parity::cpu {

/// The points that a sparse step computes: state.active, and faces with an active cell beside them.
/// All of them where state.active is empty.
class ActivePoints {
 public:
  ActivePoints(const FluidDomain& domain, const std::vector<std::uint8_t>& active)
      : cells_(domain.cells), active_(active) {}
  /// @param axis  -1: a cell.
  bool has(int axis, ivec3 point) const {
    if (active_.empty()) return true;
    return has_cell(point) || (axis >= 0 && has_cell(point - axis_step(axis)));
  }
  /// 0 where nothing is computed.
  void clear_rest(int axis, Field& field) const;

 private:
  bool has_cell(ivec3 cell) const;

  ivec3 cells_;
  const std::vector<std::uint8_t>& active_;
};

/// The state that a sparse step begins with: cells chosen, the rest empty and at rest. Source:
/// sim/fluid.h, active_cells.
FluidState choose_active(const FluidProblem& problem, const FluidState& state);

}  // namespace parity::cpu
