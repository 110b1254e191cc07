#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "sim/fluid.h"

namespace parity {
namespace {

void require(bool holds, const std::string& message) {
  if (!holds) throw std::invalid_argument("fluid: " + message);
}

void require_at_least(const char* name, double value, double low) {
  require(std::isfinite(value) && value >= low,
          std::string(name) + " is " + std::to_string(value) +
              ", must be finite and >= " + std::to_string(low));
}

void require_positive(const char* name, double value) {
  require(std::isfinite(value) && value > 0,
          std::string(name) + " is " + std::to_string(value) + ", must be finite and > 0");
}

void require_finite(const char* name, dvec3 value) {
  require(std::isfinite(value.x) && std::isfinite(value.y) && std::isfinite(value.z),
          std::string(name) + " is not finite");
}

void check_domain(const FluidDomain& domain) {
  constexpr int most = 4096;
  for (int axis = 0; axis < 3; ++axis)
    require(domain.cells[axis] >= 1 && domain.cells[axis] <= most,
            "cells along axis " + std::to_string(axis) + " are " +
                std::to_string(domain.cells[axis]) + ", must be 1 to " + std::to_string(most));
  require(domain.cell_count() <= std::size_t{1} << 27,
          "there are " + std::to_string(domain.cell_count()) + " cells, at most 2^27 are possible");
  require_positive("spacing", domain.spacing);
  require_finite("origin", domain.origin);
  for (std::size_t side = 0; side < 6; ++side) {
    const Wall& wall = domain.walls[side];
    require_finite("velocity of a wall", wall.velocity);
    require(wall.velocity[int(side / 2)] == 0,
            "wall " + std::to_string(side) + " moves through itself");
    require(
        (wall.kind == WallKind::periodic) == (domain.walls[side ^ 1].kind == WallKind::periodic),
        "walls " + std::to_string(side) + " and " + std::to_string(side ^ 1) +
            " must be periodic both or none");
  }
}

void check_parameters(const FluidParameters& p) {
  require(p.method <= FluidMethod::apic, "method " + std::to_string(std::uint32_t(p.method)) +
                                             " is none of the " +
                                             std::to_string(std::uint32_t(FluidMethod::apic) + 1));
  require_positive("density", p.density);
  require_at_least("viscosity", p.viscosity, 0);
  require_finite("force", p.force);
  require_at_least("heat_lift", p.heat_lift, 0);
  require_at_least("smoke_weight", p.smoke_weight, 0);
  require_at_least("cooling", p.cooling, 0);
  require_at_least("vorticity_confinement", p.vorticity_confinement, 0);
  require(p.flip_ratio >= 0 && p.flip_ratio <= 1,
          "flip_ratio is " + std::to_string(p.flip_ratio) + ", must be 0 to 1");
  require_positive("courant", p.courant);
  require_at_least("fixed_step", p.fixed_step, 0);
  require_positive("max_step", p.max_step);
  require(p.step_error == 0 || (p.step_error >= 1e-6 && p.step_error <= 0.1),
          "step_error is " + std::to_string(p.step_error) + ", must be 0 or 1e-6 to 0.1");
  require(p.step_error == 0 || (!is_liquid(p.method) && !p.sparse && p.fixed_step == 0),
          "step_error is for adaptive steps of fluids that fill the whole box");
  require_positive("divergence", p.divergence);
  require_at_least("busy_smoke", p.busy_smoke, 0);
  require_at_least("busy_heat", p.busy_heat, 0);
  require_at_least("busy_speed", p.busy_speed, 0);
  require(!p.sparse || is_split(p.method), "sparse needs a method that traces back, or a liquid");
  require(!p.sparse || !p.implicit_viscosity, "sparse needs explicit viscosity");
  require(!p.sparse || p.courant <= 3,
          "courant is " + std::to_string(p.courant) + ", must be at most 3 where sparse");
  require(p.max_iterations >= 1 && p.max_iterations <= 10000,
          "max_iterations is " + std::to_string(p.max_iterations) + ", must be 1 to 10000");
}

void check_field(const char* name, const Field& field, ivec3 size) {
  require(field.size == size && field.values.size() == Field(size).values.size(),
          std::string(name) + " does not fit the domain");
  require(std::ranges::all_of(field.values, [](double v) { return std::isfinite(v); }),
          std::string(name) + " has a value that is not finite");
}

void check_particles(const FluidProblem& problem) {
  const LiquidParticles& particles = problem.initial.particles;
  require(particles.velocities.size() == particles.count() &&
              particles.gradients.size() == particles.count(),
          "counts of positions, velocities and gradients differ");
  const dvec3 low = problem.domain.origin;
  const dvec3 high = low + problem.domain.spacing * dvec3(problem.domain.cells);
  for (std::size_t i = 0; i < particles.count(); ++i) {
    const dvec3 p(particles.positions[i]);
    require(glm::all(glm::greaterThanEqual(p, low)) && glm::all(glm::lessThanEqual(p, high)),
            "particle " + std::to_string(i) + " lies outside the domain");
    require_finite("velocity of a particle", dvec3(particles.velocities[i]));
  }
}

}  // namespace

void check_fluid_problem(const FluidProblem& problem) {
  check_domain(problem.domain);
  check_parameters(problem.parameters);
  require_at_least("duration", problem.duration, 0);
  require_at_least("time", problem.initial.time, 0);
  for (const FluidSolid& solid : problem.solids) {
    require_finite("center of a solid", solid.center);
    require_finite("velocity of a solid", solid.velocity);
    require_positive("half side of a solid", solid.half.x);
    require(!problem.parameters.sparse || is_liquid(problem.parameters.method) ||
                solid.velocity == dvec3(0),
            "sparse smoke needs solids at rest");
    if (solid.shape == SolidShape::box)
      require_positive("half side of a solid", std::min(solid.half.y, solid.half.z));
  }
  for (const FluidSource& source : problem.sources) {
    require_finite("center of a source", source.center);
    require_finite("velocity of a source", source.velocity);
    require_positive("radius of a source", source.radius);
    require_at_least("smoke of a source", source.smoke, 0);
    require_finite("temperature of a source", dvec3(source.temperature));
  }
  const ivec3 cells = problem.domain.cells;
  const FluidState& state = problem.initial;
  for (int axis = 0; axis < 3; ++axis)
    require(!problem.parameters.sparse || !problem.domain.is_periodic(axis),
            "sparse needs walls or open sides, axis " + std::to_string(axis) + " is periodic");
  const ivec3 tiles = (cells + fluid_tile - 1) / fluid_tile;
  const long long tile_count = 1LL * tiles.x * tiles.y * tiles.z;
  require(!problem.parameters.sparse || tile_count <= 65535,
          "there are " + std::to_string(tile_count) + " tiles, at most 65535 where sparse");
  require(state.active.empty() || state.active.size() == problem.domain.cell_count(),
          "active does not fit the domain");
  for (int axis = 0; axis < 3; ++axis)
    check_field("velocity", state.velocity[std::size_t(axis)], cells + axis_step(axis));
  check_field("pressure", state.pressure, cells);
  check_field("smoke", state.smoke, cells);
  check_field("temperature", state.temperature, cells);
  check_particles(problem);
  const std::vector<CellType> types = cell_types(problem, state);
  require(std::ranges::any_of(types, [](CellType t) { return t != CellType::solid; }),
          "solids leave no room for the fluid");
}

}  // namespace parity
