#include "cpu_reference/fluid/forces.h"

#include <algorithm>
#include <cmath>

#include "cpu_reference/fluid/tiles.h"

namespace parity::cpu {
namespace {

template <typename Visit>
void for_points(ivec3 size, const Visit& visit) {
  for (int z = 0; z < size.z; ++z)
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) visit(ivec3(x, y, z));
}

std::size_t cell_index(const FluidDomain& domain, ivec3 cell) {
  cell = glm::clamp(cell, ivec3(0), domain.cells - 1);
  return (std::size_t(cell.z) * std::size_t(domain.cells.y) + std::size_t(cell.y)) *
             std::size_t(domain.cells.x) +
         std::size_t(cell.x);
}

dvec3 middle_velocity(const FluidDomain& domain, const FaceFields& velocity, ivec3 cell) {
  cell = glm::clamp(cell, ivec3(0), domain.cells - 1);
  dvec3 u;
  for (int a = 0; a < 3; ++a)
    u[a] = (velocity[std::size_t(a)](cell) + velocity[std::size_t(a)](cell + axis_step(a))) / 2;
  return u;
}

/// Accelerations of confinement in cells: h epsilon N x omega.
std::vector<dvec3> confinement(const FluidProblem& problem, const FluidState& state) {
  const FluidDomain& domain = problem.domain;
  const FaceFields& velocity = state.velocity;
  const ActivePoints active(domain, state.active);
  const double h = domain.spacing;
  std::vector<dvec3> curl(domain.cell_count()), result(domain.cell_count());
  for_points(domain.cells, [&](ivec3 cell) {
    if (!active.has(-1, cell)) return;
    dmat3 slope;  // column d: derivative along d
    for (int d = 0; d < 3; ++d)
      slope[d] = (middle_velocity(domain, velocity, cell + axis_step(d)) -
                  middle_velocity(domain, velocity, cell - axis_step(d))) /
                 (2 * h);
    curl[cell_index(domain, cell)] = {slope[1][2] - slope[2][1], slope[2][0] - slope[0][2],
                                      slope[0][1] - slope[1][0]};
  });
  for_points(domain.cells, [&](ivec3 cell) {
    dvec3 towards;
    for (int d = 0; d < 3; ++d)
      towards[d] = (glm::length(curl[cell_index(domain, cell + axis_step(d))]) -
                    glm::length(curl[cell_index(domain, cell - axis_step(d))])) /
                   (2 * h);
    towards /= glm::length(towards) + 1e-3 / h;
    const std::size_t i = cell_index(domain, cell);
    result[i] = problem.parameters.vorticity_confinement * h * glm::cross(towards, curl[i]);
  });
  return result;
}

/// The two cells beside a face; at the ends of the domain the one that is there, twice.
std::array<std::size_t, 2> cells_beside(const FluidDomain& domain, int axis, ivec3 face) {
  ivec3 above = face, below = face - axis_step(axis);
  if (domain.is_periodic(axis)) {
    const int count = domain.cells[axis];
    above[axis] %= count;
    below[axis] = (below[axis] + count) % count;
  }
  return {cell_index(domain, below), cell_index(domain, above)};
}

bool in_closed_wall(const FluidDomain& domain, int axis, ivec3 face) {
  if (face[axis] != 0 && face[axis] != domain.cells[axis]) return false;
  const WallKind kind = domain.walls[std::size_t(2 * axis + (face[axis] == 0 ? 0 : 1))].kind;
  return kind == WallKind::no_slip || kind == WallKind::free_slip;
}

}  // namespace

FluidState hold_sources(const FluidProblem& problem, const FluidState& state, double seconds) {
  FluidState result = state;
  for (double& heat : result.temperature.values) heat /= 1 + problem.parameters.cooling * seconds;
  for (const FluidSource& source : problem.sources)
    for_points(problem.domain.cells, [&](ivec3 cell) {
      const dvec3 position = point_position(problem.domain, -1, cell);
      if (glm::distance(position, source.center) > source.radius) return;
      result.smoke(cell) = source.smoke;
      result.temperature(cell) = source.temperature;
    });
  return result;
}

FluidState push(const FluidProblem& problem, const FluidState& state, double seconds) {
  const FluidDomain& domain = problem.domain;
  const FluidParameters& p = problem.parameters;
  std::vector<dvec3> acceleration(domain.cell_count(), p.force);
  if (p.vorticity_confinement > 0) acceleration = confinement(problem, state);
  for (std::size_t i = 0; i < acceleration.size(); ++i) {
    if (p.vorticity_confinement > 0) acceleration[i] += p.force;
    acceleration[i].y +=
        p.heat_lift * state.temperature.values[i] - p.smoke_weight * state.smoke.values[i];
  }
  const ActivePoints active(domain, state.active);
  FluidState result = state;
  for (int axis = 0; axis < 3; ++axis) {
    Field& u = result.velocity[std::size_t(axis)];
    for_points(u.size, [&](ivec3 face) {
      if (in_closed_wall(domain, axis, face) || !active.has(axis, face)) return;
      const auto [below, above] = cells_beside(domain, axis, face);
      u(face) += seconds * (acceleration[below][axis] + acceleration[above][axis]) / 2;
      for (const FluidSource& source : problem.sources)
        if (source.velocity != dvec3(0) &&
            glm::distance(point_position(domain, axis, face), source.center) <= source.radius)
          u(face) = source.velocity[axis];
    });
  }
  return result;
}

}  // namespace parity::cpu
