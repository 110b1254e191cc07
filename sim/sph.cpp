#include "sim/sph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace parity {
namespace {

[[noreturn]] void refuse(const std::string& what, const std::string& expected) {
  throw std::invalid_argument("sph: " + what + ", must be " + expected);
}

void check_number(const char* name, double value, double least, double most = 1e30) {
  if (!(value >= least && value <= most))
    refuse(std::string(name) + " is " + std::to_string(value),
           "in " + std::to_string(least) + " to " + std::to_string(most));
}

bool finite(const dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool inside(const SphBox& box, const dvec3& p, std::uint32_t dimensions) {
  for (std::uint32_t k = 0; k < dimensions; ++k)
    if (!(p[int(k)] >= box.low[int(k)] && p[int(k)] <= box.high[int(k)])) return false;
  return true;
}

void check_points(const char* name, const std::vector<vec3>& points, std::uint32_t dimensions) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string who = std::string(name) + " of particle " + std::to_string(i);
    if (!finite(dvec3(points[i]))) refuse(who + " is not finite", "finite");
    if (dimensions == 2 && points[i].z != 0)
      refuse(who + " has z " + std::to_string(points[i].z), "0 in 2 dimensions");
  }
}

void check_motions(const SphProblem& problem) {
  const std::vector<vec4>& motions = problem.boundary_motions;
  if (!motions.empty() && motions.size() != problem.boundary.size())
    refuse("boundary_motions are " + std::to_string(motions.size()),
           "none or as many as wall particles, " + std::to_string(problem.boundary.size()));
  for (std::size_t i = 0; i < motions.size(); ++i)
    if (!finite(dvec3(motions[i])) || !(motions[i].w >= 0 && motions[i].w <= 1) ||
        (problem.parameters.dimensions == 2 && motions[i].z != 0))
      refuse("boundary motion of particle " + std::to_string(i) + " is not one",
             "finite, in the plane in 2 dimensions, its share in 0 to 1");
}

/// Cells of one spacing along each axis of a box.
ivec3 cells_of(const SphBox& box, double spacing, std::uint32_t dimensions) {
  ivec3 cells(1);
  for (int k = 0; k < int(dimensions); ++k)
    cells[k] = int(std::lround((box.high[k] - box.low[k]) / spacing));
  return glm::max(cells, ivec3(0));
}

}  // namespace

void check_sph_parameters(const SphParameters& p) {
  if (p.dimensions != 2 && p.dimensions != 3)
    refuse("dimensions is " + std::to_string(p.dimensions), "2 or 3");
  check_number("spacing", p.spacing, 1e-6);
  check_number("support / spacing", p.support / p.spacing, 1.0 + 1e-9, 4);
  check_number("rest_density", p.rest_density, 1e-6);
  check_number("sound_speed", p.sound_speed, 1e-6);
  check_number("artificial_viscosity", p.artificial_viscosity, 0);
  check_number("viscosity", p.viscosity, 0);
  check_number("viscosity_error", p.viscosity_error, 1e-7, 1);
  check_number("surface_tension", p.surface_tension, 0);
  check_number("courant", p.courant, 1e-6, 1);
  check_number("fixed_step", p.fixed_step, 0);
  check_number("max_step", p.max_step, 1e-12);
  check_number("density_error", p.density_error, 1e-7, 1);
  check_number("max_iterations", p.max_iterations, 1, 10000);
  if (!finite(p.gravity)) refuse("gravity is not finite", "finite");
  if (p.dimensions == 2 && p.gravity.z != 0) refuse("gravity has a z", "in the plane");
}

double particle_mass(const SphParameters& p) {
  return p.rest_density * std::pow(p.spacing, int(p.dimensions));
}

void check_sph_problem(const SphProblem& problem) {
  const SphParameters& p = problem.parameters;
  check_sph_parameters(p);
  const SphState& state = problem.initial;
  if (state.positions.size() != state.velocities.size())
    refuse("velocities are " + std::to_string(state.velocities.size()),
           "as many as positions, " + std::to_string(state.positions.size()));
  if (!state.pressures.empty() && state.pressures.size() != state.positions.size())
    refuse("pressures are " + std::to_string(state.pressures.size()),
           "none or as many as positions, " + std::to_string(state.positions.size()));
  check_points("position", state.positions, p.dimensions);
  check_points("velocity", state.velocities, p.dimensions);
  check_points("boundary position", problem.boundary, p.dimensions);
  check_motions(problem);
  double cells = 1;
  for (int k = 0; k < int(p.dimensions); ++k) {
    const double side = problem.domain.high[k] - problem.domain.low[k];
    check_number("side of the domain", side, p.spacing);
    cells *= side / p.support + 3;
  }
  check_number("number of cells of the domain", cells, 1, 0x1p24);
  for (std::size_t i = 0; i < state.positions.size(); ++i)
    if (!inside(problem.domain, dvec3(state.positions[i]), p.dimensions))
      refuse("particle " + std::to_string(i) + " is outside", "inside the domain");
  check_number("duration", problem.duration, 0);
}

std::vector<vec3> fill_box(const SphBox& box, double spacing, std::uint32_t dimensions) {
  const ivec3 cells = cells_of(box, spacing, dimensions);
  std::vector<vec3> points;
  for (int z = 0; z < cells.z; ++z)
    for (int y = 0; y < cells.y; ++y)
      for (int x = 0; x < cells.x; ++x) {
        dvec3 p = box.low + spacing * (dvec3(x, y, z) + 0.5);
        if (dimensions == 2) p.z = 0;
        points.emplace_back(p);
      }
  return points;
}

std::vector<vec3> cover_box(const SphBox& box, double spacing, std::uint32_t dimensions,
                            bool outside, bool open_top) {
  const ivec3 last = cells_of(box, spacing, dimensions) + (outside ? 1 : -1);
  const double shift = outside ? -0.5 : 0.5;
  std::vector<vec3> points;
  const int depth = dimensions == 3 ? last.z : 0;
  for (int z = 0; z <= depth; ++z)
    for (int y = 0; y <= last.y; ++y)
      for (int x = 0; x <= last.x; ++x) {
        const bool side = x == 0 || x == last.x || (dimensions == 3 && (z == 0 || z == last.z));
        const bool top = y == last.y && !open_top;
        if (!side && y != 0 && !top) continue;
        dvec3 p = box.low + spacing * (dvec3(x, y, z) + shift);
        if (dimensions == 2) p.z = 0;
        points.emplace_back(p);
      }
  return points;
}

SphMeasures measure(const SphParameters& parameters, const SphState& state) {
  SphMeasures m;
  const double mass = particle_mass(parameters);
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    const dvec3 x{state.positions[i]};
    const dvec3 v{state.velocities[i]};
    m.momentum += mass * v;
    m.kinetic_energy += 0.5 * mass * glm::dot(v, v);
    m.potential_energy -= mass * glm::dot(parameters.gravity, x);
    m.center += x;
    m.low = i == 0 ? x : glm::min(m.low, x);
    m.high = i == 0 ? x : glm::max(m.high, x);
    m.max_speed = std::max(m.max_speed, glm::length(v));
  }
  m.mass = mass * double(state.positions.size());
  if (!state.positions.empty()) m.center /= double(state.positions.size());
  return m;
}

SphDensityError density_error(const SphParameters& parameters, std::span<const float> densities) {
  SphDensityError error;
  for (const float density : densities) {
    const double compression = std::max(0.0, double(density) / parameters.rest_density - 1);
    error.average += compression;
    error.largest = std::max(error.largest, compression);
  }
  if (!densities.empty()) error.average /= double(densities.size());
  return error;
}

}  // namespace parity
