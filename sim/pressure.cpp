#include "sim/pressure.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "geometry/random.h"

namespace parity {
namespace {

template <typename Visit>
void for_cells(ivec3 size, const Visit& visit) {
  for (int z = 0; z < size.z; ++z)
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) visit(ivec3(x, y, z));
}

/// Pressure of the neighbour of `cell` on one side; 0 beyond the domain.
double neighbour(const PressureProblem& problem, const Field& p, ivec3 cell, int axis, int side) {
  ivec3 other = cell;
  other[axis] += side;
  const int count = problem.cells[axis];
  if (problem.periodic[std::size_t(axis)]) other[axis] = (other[axis] + count) % count;
  return other[axis] < 0 || other[axis] >= count ? 0 : p(other);
}

bool is_fluid(const PressureProblem& problem, ivec3 cell) {
  return problem.types[problem.rhs.index(cell.x, cell.y, cell.z)] == CellType::fluid;
}

FluidProblem box_of(ivec3 cells, PressureCase kind) {
  FluidProblem fluid;
  fluid.domain = {.cells = cells, .spacing = 1.0 / cells.x};
  for (Wall& wall : fluid.domain.walls) wall.kind = WallKind::free_slip;
  auto& walls = fluid.domain.walls;
  if (kind == PressureCase::open_top) walls[3].kind = WallKind::open;
  if (kind == PressureCase::periodic) walls[0].kind = walls[1].kind = WallKind::periodic;
  const dvec3 size = fluid.domain.spacing * dvec3(cells);
  if (kind == PressureCase::sphere) {
    const double radius = 0.23 * std::min({size.x, size.y, cells.z > 1 ? size.z : size.x});
    fluid.solids.push_back({.center = 0.45 * size, .half = dvec3(radius)});
    if (cells.z == 1) fluid.solids[0].center.z = 0.5 * size.z;
  }
  fluid.initial = resting_state(fluid.domain);
  if (kind == PressureCase::liquid) {
    fluid.parameters.method = FluidMethod::flip;
    add_liquid(fluid, dvec3(0), {0.55 * size.x, 0.8 * size.y, size.z});
    add_liquid(fluid, dvec3(0), {size.x, 0.3 * size.y, size.z});
  }
  return fluid;
}

}  // namespace

PressureProblem pressure_problem(const FluidProblem& fluid, const FluidState& state, double step) {
  const FluidDomain& domain = fluid.domain;
  PressureProblem problem;
  problem.cells = domain.cells;
  for (int axis = 0; axis < 3; ++axis)
    problem.periodic[std::size_t(axis)] = domain.is_periodic(axis);
  problem.types = cell_types(fluid, state);
  problem.open = open_fractions(domain, fluid.solids, state.time);
  problem.rhs = divergence(domain, state.velocity, problem.open,
                           boundary_velocity(domain, fluid.solids, state.time));
  const double scale = fluid.parameters.density * domain.spacing * domain.spacing / step;
  for (std::size_t i = 0; i < problem.types.size(); ++i)
    problem.rhs.values[i] *= problem.types[i] == CellType::fluid ? -scale : 0;
  problem.guess = state.pressure;
  problem.tolerance = fluid.parameters.divergence * scale;
  problem.max_iterations = int(fluid.parameters.max_iterations);
  if (is_singular(problem)) remove_mean(problem, problem.rhs);
  return problem;
}

Field pressure_residual(const PressureProblem& problem, const Field& pressure) {
  Field residual(problem.cells);
  for_cells(problem.cells, [&](ivec3 cell) {
    if (!is_fluid(problem, cell)) return;
    double sum = problem.rhs(cell);
    for (int axis = 0; axis < 3; ++axis) {
      const Field& open = problem.open[std::size_t(axis)];
      const double p = pressure(cell);
      sum -= open(cell) * (p - neighbour(problem, pressure, cell, axis, -1));
      sum -= open(cell + axis_step(axis)) * (p - neighbour(problem, pressure, cell, axis, 1));
    }
    residual(cell) = sum;
  });
  return residual;
}

double largest_magnitude(const Field& field) {
  double largest = 0;
  for (const double value : field.values) {
    if (std::isnan(value)) return value;
    largest = std::max(largest, std::abs(value));
  }
  return largest;
}

bool is_singular(const PressureProblem& problem) {
  // A constant can be told only by a cell with an open face to air or to the outside.
  Field one(problem.cells);
  for (std::size_t i = 0; i < one.values.size(); ++i)
    one.values[i] = problem.types[i] == CellType::fluid ? 1 : 0;
  PressureProblem still = problem;
  std::ranges::fill(still.rhs.values, 0.0);
  return largest_magnitude(pressure_residual(still, one)) == 0;
}

void remove_mean(const PressureProblem& problem, Field& field) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    if (problem.types[i] != CellType::fluid) continue;
    sum += field.values[i];
    ++count;
  }
  for (std::size_t i = 0; i < field.values.size(); ++i)
    if (problem.types[i] == CellType::fluid) field.values[i] -= sum / double(count);
}

PressureProblem make_pressure_problem(ivec3 cells, PressureCase kind, double tolerance,
                                      std::uint64_t seed) {
  if (cells.x < 1 || cells.y < 1 || cells.z < 1)
    throw std::invalid_argument("make_pressure_problem: a side is below 1 cell");
  if (kind == PressureCase::periodic && cells.x % 2 != 0)
    throw std::invalid_argument("make_pressure_problem: " + std::to_string(cells.x) +
                                " cells along the periodic axis, must be even");
  const FluidProblem fluid = box_of(cells, kind);
  PressureProblem problem = pressure_problem(fluid, fluid.initial, 1);
  Random random(seed, 3);
  const dvec3 middle = 0.5 * dvec3(cells);
  for_cells(cells, [&](ivec3 cell) {
    if (!is_fluid(problem, cell)) return;
    const dvec3 from = (dvec3(cell) + 0.5 - middle) / double(cells.x);
    const auto blob = [&](double x) {
      const dvec3 d = from - dvec3(x, 0.1, 0);
      return std::exp(-30 * glm::dot(d, d));
    };
    problem.rhs(cell) = blob(-0.3) - blob(0.3) + 0.1 * random.uniform(-1, 1);
  });
  if (is_singular(problem)) remove_mean(problem, problem.rhs);
  std::ranges::fill(problem.guess.values, 0.0);
  problem.tolerance = tolerance * largest_magnitude(problem.rhs);
  problem.max_iterations = 1000;
  return problem;
}

}  // namespace parity
