#pragma once

#include <algorithm>
#include <cmath>
#include <tuple>

#include "geometry/random.h"
#include "sim/fluid.h"
#include "tests/numbers.h"
#include "tests/numerics/pressure_fields.h"
#include "tests/setting.h"

/// Problems and comparisons that the records of the fluid chapter share.
namespace parity {

struct FluidStepProblem {
  FluidProblem fluid;
  double seconds = 0;
};
inline auto fields_of(const LiquidParticles*) {
  return std::tuple{&LiquidParticles::positions, &LiquidParticles::velocities};
}
inline auto fields_of(const FluidState*) {
  return std::tuple{&FluidState::velocity, &FluidState::smoke, &FluidState::temperature,
                    &FluidState::particles};
}
inline auto fields_of(const FluidProblem*) { return std::tuple{&FluidProblem::initial}; }
inline auto fields_of(const FluidStepProblem*) {
  return std::tuple{&FluidStepProblem::fluid, &FluidStepProblem::seconds};
}

inline double largest_apart(const Field& a, const Field& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i)
    largest = std::max(largest, std::abs(a.values[i] - b.values[i]));
  return largest;
}

/// Largest difference of velocities, smoke, and temperature over 10 K; m/s.
inline double states_apart(const FluidState& got, const FluidState& want) {
  double largest = std::max(largest_apart(got.smoke, want.smoke),
                            largest_apart(got.temperature, want.temperature) / 10);
  for (std::size_t axis = 0; axis < 3; ++axis)
    largest = std::max(largest, largest_apart(got.velocity[axis], want.velocity[axis]));
  return largest;
}

/// Particles in their own order: the worst of places in cells and velocities in m/s.
inline double particles_apart(const FluidProblem& problem, const FluidState& got,
                              const FluidState& want) {
  double largest = 0;
  for (std::size_t i = 0; i < want.particles.count(); ++i) {
    const double moved =
        double(glm::distance(got.particles.positions[i], want.particles.positions[i]));
    const double speed =
        double(glm::distance(got.particles.velocities[i], want.particles.velocities[i]));
    largest = std::max({largest, moved / problem.domain.spacing, speed});
  }
  return largest;
}

/// Random contents; nothing flows through walls, and the two ends of a periodic axis are one.
inline void fill_randomly(FluidProblem& problem, std::uint64_t seed) {
  Random random(seed, 9);
  FluidState& state = problem.initial;
  for (int axis = 0; axis < (problem.domain.is_flat() ? 2 : 3); ++axis) {
    Field& u = state.velocity[std::size_t(axis)];
    const int last = problem.domain.cells[axis];
    for (int z = 0; z < u.size.z; ++z)
      for (int y = 0; y < u.size.y; ++y)
        for (int x = 0; x < u.size.x; ++x) {
          const ivec3 face(x, y, z);
          ivec3 first = face;
          first[axis] = 0;
          const bool is_end = face[axis] == 0 || face[axis] == last;
          const Wall& wall = problem.domain.walls[std::size_t(2 * axis + (face[axis] != 0))];
          u(face) = double(random.uniform(-1, 1));
          if (is_end && (wall.kind == WallKind::no_slip || wall.kind == WallKind::free_slip))
            u(face) = 0;
          if (face[axis] == last && wall.kind == WallKind::periodic) u(face) = u(first);
        }
  }
  for (double& value : state.smoke.values) value = double(random.uniform());
  for (double& value : state.temperature.values) value = double(random.uniform(0, 10));
}

/// Kinds of boxes: 0 plain, 1 a ball, 2 a ball that moves under an open top, 3 periodic with a
/// moving wall. All with forces, viscosity and random contents.
inline FluidStepProblem random_fluid_step(const Setting& setting) {
  const int side = 2 * (setting.count("side") / 2);
  FluidStepProblem problem{.fluid = smoke_plume(side, 2), .seconds = setting.at("seconds")};
  FluidProblem& fluid = problem.fluid;
  const int kind = setting.count("kind");
  fluid.domain.cells = {side, side + 3, setting.count("dimensions") == 2 ? 1 : side - 1};
  fluid.initial = resting_state(fluid.domain);
  const dvec3 size = fluid.domain.spacing * dvec3(fluid.domain.cells);
  fluid.solids[0] = {.center = 0.47 * size, .half = dvec3(0.2)};
  fluid.sources[0].center = {0.5, 0.2, size.z / 2};
  if (kind == 0 || kind == 3) fluid.solids.clear();
  auto& walls = fluid.domain.walls;
  if (kind == 2) {
    walls[3].kind = WallKind::open;
    fluid.solids[0].velocity = {0.4, -0.1, 0};
  }
  if (kind == 3) {
    walls[0].kind = walls[1].kind = WallKind::periodic;
    walls[3] = {.kind = WallKind::no_slip, .velocity = {1, 0, 0}};
  }
  fluid.parameters.force = {0.3, -1, 0};
  fluid.parameters.viscosity = 1e-3;
  fluid.parameters.divergence = 2e-5;
  fluid.parameters.max_iterations = 60;
  fill_randomly(fluid, setting.seed);
  return problem;
}

/// Axes of random_fluid_step.
inline std::vector<Axis> random_fluid_axes() {
  return {{.name = "side", .low = 4, .high = 26, .standard = 12, .whole = true},
          {.name = "dimensions", .low = 2, .high = 3, .standard = 3, .whole = true},
          {.name = "kind", .low = 0, .high = 3, .standard = 1, .whole = true, .each = true},
          {.name = "seconds",
           .unit = "s",
           .low = 1e-3,
           .high = 0.1,
           .standard = 0.02,
           .logarithmic = true}};
}

/// Two projections that keep a divergence of D each differ by a flow that D feeds across the box,
/// at most 2 D L; float adds 2^-24 of speeds and changes of up to `speed` in each of `operations`.
inline double flow_tolerance(const FluidStepProblem& problem, double operations) {
  const FluidDomain& domain = problem.fluid.domain;
  const ivec3 n = domain.cells;
  const double length = domain.spacing * std::max({n.x, n.y, n.z});
  const double speed = 2 + problem.seconds * (1 + 0.05 * 60);
  return 2 * problem.fluid.parameters.divergence * length + operations * speed * 0x1p-24;
}

}  // namespace parity
