#include "sim/fluid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace parity {
namespace {

double box_distance(const FluidSolid& solid, dvec3 from_center) {
  const dvec3 outside = glm::abs(from_center) - solid.half;
  return glm::length(glm::max(outside, dvec3(0))) +
         std::min(std::max({outside.x, outside.y, outside.z}), 0.0);
}

double distance_to(const FluidSolid& solid, double time, dvec3 position) {
  const dvec3 from_center = position - (solid.center + time * solid.velocity);
  if (solid.shape == SolidShape::sphere) return glm::length(from_center) - solid.half.x;
  return box_distance(solid, from_center);
}

/// Calls visit(point) for every point of a box, x fastest.
template <typename Visit>
void for_points(ivec3 size, const Visit& visit) {
  for (int z = 0; z < size.z; ++z)
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) visit(ivec3(x, y, z));
}

/// The wall that the face is part of; null inside the domain.
const Wall* wall_of(const FluidDomain& domain, int axis, ivec3 face) {
  if (face[axis] != 0 && face[axis] != domain.cells[axis]) return nullptr;
  return &domain.walls[std::size_t(2 * axis + (face[axis] == 0 ? 0 : 1))];
}

double open_fraction(const FluidDomain& domain, const std::vector<FluidSolid>& solids, double time,
                     int axis, ivec3 face) {
  const ivec3 across = axis_step((axis + 1) % 3), up = axis_step((axis + 2) % 3);
  double outside = 0, all = 0;
  for (const ivec3 corner : {face, face + across, face + up, face + across + up}) {
    const double distance =
        solid_distance(solids, time, domain.origin + domain.spacing * dvec3(corner));
    if (std::isinf(distance)) return 1;
    outside += std::max(distance, 0.0);
    all += std::abs(distance);
  }
  return all > 0 ? std::round(open_steps * (outside / all)) / open_steps : 0;
}

}  // namespace

FaceFields face_fields(ivec3 cells, double value) {
  return {Field(cells + axis_step(0), value), Field(cells + axis_step(1), value),
          Field(cells + axis_step(2), value)};
}

FluidState resting_state(const FluidDomain& domain) {
  FluidState state;
  state.velocity = face_fields(domain.cells);
  state.pressure = state.smoke = state.temperature = Field(domain.cells);
  return state;
}

double solid_distance(const std::vector<FluidSolid>& solids, double time, dvec3 position) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const FluidSolid& solid : solids)
    nearest = std::min(nearest, distance_to(solid, time, position));
  return nearest;
}

dvec3 solid_velocity(const std::vector<FluidSolid>& solids, double time, dvec3 position) {
  double nearest = std::numeric_limits<double>::infinity();
  dvec3 velocity{0};
  for (const FluidSolid& solid : solids) {
    const double distance = distance_to(solid, time, position);
    if (distance >= nearest) continue;
    nearest = distance;
    velocity = solid.velocity;
  }
  return velocity;
}

dvec3 point_position(const FluidDomain& domain, int axis, ivec3 point) {
  dvec3 offset{0.5};
  if (axis >= 0) offset[axis] = 0;
  return domain.origin + domain.spacing * (dvec3(point) + offset);
}

ivec3 particle_cell(const FluidDomain& domain, vec3 position) {
  const float cells_per_metre = float(1 / domain.spacing);
  const vec3 cell = (position - vec3(domain.origin)) * cells_per_metre;
  return glm::clamp(ivec3(glm::floor(cell)), ivec3(0), domain.cells - 1);
}

FaceFields open_fractions(const FluidDomain& domain, const std::vector<FluidSolid>& solids,
                          double time) {
  FaceFields open = face_fields(domain.cells);
  for (int axis = 0; axis < 3; ++axis)
    for_points(open[std::size_t(axis)].size, [&](ivec3 face) {
      const Wall* wall = wall_of(domain, axis, face);
      const bool closed =
          wall != nullptr && (wall->kind == WallKind::no_slip || wall->kind == WallKind::free_slip);
      if (!closed) open[std::size_t(axis)](face) = open_fraction(domain, solids, time, axis, face);
    });
  return open;
}

FaceFields boundary_velocity(const FluidDomain& domain, const std::vector<FluidSolid>& solids,
                             double time) {
  FaceFields velocity = face_fields(domain.cells);
  if (solids.empty()) return velocity;
  for (int axis = 0; axis < 3; ++axis)
    for_points(velocity[std::size_t(axis)].size, [&](ivec3 face) {
      const Wall* wall = wall_of(domain, axis, face);
      const bool in_wall =
          wall != nullptr && (wall->kind == WallKind::no_slip || wall->kind == WallKind::free_slip);
      if (!in_wall)
        velocity[std::size_t(axis)](face) =
            solid_velocity(solids, time, point_position(domain, axis, face))[axis];
    });
  return velocity;
}

std::vector<CellType> cell_types(const FluidProblem& problem, const FluidState& state) {
  const FluidDomain& domain = problem.domain;
  const FaceFields open = open_fractions(domain, problem.solids, state.time);
  const bool liquid = is_liquid(problem.parameters.method);
  std::vector<CellType> types(domain.cell_count(), liquid ? CellType::air : CellType::fluid);
  const Field index(domain.cells);
  for (const vec3 position : state.particles.positions) {
    const ivec3 cell = particle_cell(domain, position);
    types[index.index(cell.x, cell.y, cell.z)] = CellType::fluid;
  }
  for_points(domain.cells, [&](ivec3 cell) {
    double room = 0;
    for (int axis = 0; axis < 3; ++axis)
      room += open[std::size_t(axis)](cell) + open[std::size_t(axis)](cell + axis_step(axis));
    if (room == 0) types[index.index(cell.x, cell.y, cell.z)] = CellType::solid;
  });
  for (std::size_t i = 0; i < state.active.size(); ++i)
    if (state.active[i] == 0) types[i] = CellType::air;
  return types;
}

Field divergence(const FluidDomain& domain, const FaceFields& velocity, const FaceFields& open,
                 const FaceFields& boundary) {
  Field result(domain.cells);
  for_points(domain.cells, [&](ivec3 cell) {
    double flux = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const ivec3 above = cell + axis_step(int(axis));
      const auto through = [&](ivec3 face) {
        const double part = open[axis](face);
        return part * velocity[axis](face) + (1 - part) * boundary[axis](face);
      };
      flux += through(above) - through(cell);
    }
    result(cell) = flux / domain.spacing;
  });
  return result;
}

double liquid_particle_mass(const FluidProblem& problem) {
  const double volume = std::pow(problem.domain.spacing, 3);
  return problem.parameters.density * volume / (problem.domain.is_flat() ? 4 : 8);
}

namespace {

void measure_particles(const FluidProblem& problem, const FluidState& state, FluidMeasures& m) {
  const double mass = liquid_particle_mass(problem);
  m.front = problem.domain.origin.x;
  for (std::size_t i = 0; i < state.particles.count(); ++i) {
    const dvec3 velocity(state.particles.velocities[i]);
    m.momentum += mass * velocity;
    m.kinetic_energy += mass / 2 * glm::dot(velocity, velocity);
    m.front = std::max(m.front, double(state.particles.positions[i].x));
  }
  m.mass = mass * double(state.particles.count());
}

/// Each face stands for the half cells on both sides; on a boundary of the domain for one.
void measure_faces(const FluidProblem& problem, const FluidState& state, FluidMeasures& m) {
  const double cell_mass = problem.parameters.density * std::pow(problem.domain.spacing, 3);
  for (int axis = 0; axis < 3; ++axis) {
    const Field& u = state.velocity[std::size_t(axis)];
    for_points(u.size, [&](ivec3 face) {
      const double part = wall_of(problem.domain, axis, face) == nullptr ? 1 : 0.5;
      m.momentum[axis] += part * cell_mass * u(face);
      m.kinetic_energy += part * cell_mass / 2 * u(face) * u(face);
    });
  }
}

}  // namespace

FluidMeasures measure(const FluidProblem& problem, const FluidState& state) {
  FluidMeasures m;
  const FluidDomain& domain = problem.domain;
  const Field div =
      divergence(domain, state.velocity, open_fractions(domain, problem.solids, state.time),
                 boundary_velocity(domain, problem.solids, state.time));
  const std::vector<CellType> types = cell_types(problem, state);
  for (std::size_t i = 0; i < types.size(); ++i)
    if (types[i] == CellType::fluid) m.divergence = std::max(m.divergence, std::abs(div.values[i]));
  for (const Field& u : state.velocity)
    for (const double value : u.values) m.max_speed = std::max(m.max_speed, std::abs(value));
  const double volume = std::pow(domain.spacing, 3);
  for (const double value : state.temperature.values) m.heat += value * volume;
  if (is_liquid(problem.parameters.method)) {
    measure_particles(problem, state, m);
  } else {
    measure_faces(problem, state, m);
    for (const double value : state.smoke.values) m.mass += value * volume;
  }
  return m;
}

}  // namespace parity
