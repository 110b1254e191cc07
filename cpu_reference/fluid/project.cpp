#include "cpu_reference/fluid/project.h"

#include <stdexcept>
#include <string>

#include "cpu_reference/fluid/tiles.h"
#include "cpu_reference/numerics/conjugate_gradient.h"
#include "sim/pressure.h"

namespace parity::cpu {
namespace {

/// Pressure and type of a cell that may lie one outside.
struct Neighbour {
  double pressure = 0;
  bool is_fluid = false;
};

Neighbour neighbour(const FluidDomain& domain, const PressureProblem& system, const Field& pressure,
                    ivec3 cell) {
  for (int axis = 0; axis < 3; ++axis) {
    const int count = domain.cells[axis];
    if (domain.is_periodic(axis)) cell[axis] = (cell[axis] + count) % count;
    if (cell[axis] < 0 || cell[axis] >= count) return {};
  }
  return {pressure(cell), system.types[pressure.index(cell.x, cell.y, cell.z)] == CellType::fluid};
}

}  // namespace

FluidState project(const FluidProblem& problem, const FluidState& state, double seconds) {
  if (!(seconds > 0))
    throw std::invalid_argument("cpu::project: seconds is " + std::to_string(seconds) +
                                ", must be > 0");
  const FluidDomain& domain = problem.domain;
  PressureProblem system = pressure_problem(problem, state, seconds);
  system.max_iterations = 10000;
  FluidState result = state;
  result.pressure = conjugate_gradient(system, Preconditioner::incomplete_cholesky).pressure;
  const FaceFields boundary = boundary_velocity(domain, problem.solids, state.time);
  const ActivePoints active(domain, state.active);
  const double scale = seconds / (problem.parameters.density * domain.spacing);
  for (int axis = 0; axis < 3; ++axis) {
    Field& u = result.velocity[std::size_t(axis)];
    const Field& open = system.open[std::size_t(axis)];
    for (int z = 0; z < u.size.z; ++z)
      for (int y = 0; y < u.size.y; ++y)
        for (int x = 0; x < u.size.x; ++x) {
          const ivec3 face(x, y, z);
          if (!active.has(axis, face)) continue;
          if (open(face) == 0) {
            u(face) = boundary[std::size_t(axis)](face);
            continue;
          }
          const Neighbour above = neighbour(domain, system, result.pressure, face);
          const Neighbour below =
              neighbour(domain, system, result.pressure, face - axis_step(axis));
          if (above.is_fluid || below.is_fluid)
            u(face) -= scale * (above.pressure - below.pressure);
        }
  }
  return result;
}

}  // namespace parity::cpu
