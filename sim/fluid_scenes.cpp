#include <cmath>
#include <numbers>

#include "geometry/random.h"
#include "sim/fluid.h"

namespace parity {
namespace {

constexpr double pi = std::numbers::pi;

FluidDomain box_domain(ivec3 cells, double spacing, WallKind kind) {
  FluidDomain domain{.cells = cells, .spacing = spacing};
  for (Wall& wall : domain.walls) wall.kind = kind;
  if (domain.is_flat()) domain.walls[4].kind = domain.walls[5].kind = WallKind::free_slip;
  return domain;
}

FluidProblem problem_in(const FluidDomain& domain, const FluidParameters& parameters) {
  return {.domain = domain,
          .parameters = parameters,
          .solids = {},
          .sources = {},
          .initial = resting_state(domain)};
}

/// A channel along x, one wall at y = 0 and one at y = 1, periodic elsewhere.
FluidDomain channel(int cells) {
  FluidDomain domain = box_domain({4, cells, 1}, 1.0 / cells, WallKind::no_slip);
  domain.walls[0].kind = domain.walls[1].kind = WallKind::periodic;
  return domain;
}

/// The thickness of a tank: one cell, or `depth` of them.
int thickness(int dimensions, int depth) { return dimensions == 2 ? 1 : depth; }

}  // namespace

FluidProblem lid_driven_cavity(int cells, double reynolds) {
  FluidDomain domain = box_domain({cells, cells, 1}, 1.0 / cells, WallKind::no_slip);
  domain.walls[3].velocity = {1, 0, 0};
  FluidProblem problem =
      problem_in(domain, {.method = FluidMethod::central, .viscosity = 1 / reynolds});
  problem.duration = 20;
  return problem;
}

FaceFields taylor_green_velocity(const FluidDomain& domain, double viscosity, double time) {
  FaceFields velocity = face_fields(domain.cells);
  const double decay = std::exp(-2 * viscosity * time);
  for (int axis = 0; axis < 2; ++axis) {
    Field& u = velocity[std::size_t(axis)];
    for (int z = 0; z < u.size.z; ++z)
      for (int y = 0; y < u.size.y; ++y)
        for (int x = 0; x < u.size.x; ++x) {
          const dvec3 p = point_position(domain, axis, {x, y, z});
          u(x, y, z) = axis == 0 ? decay * std::sin(p.x) * std::cos(p.y)
                                 : -decay * std::cos(p.x) * std::sin(p.y);
        }
  }
  // The sine of the rounded pi is not 0; walls are.
  Field &u = velocity[0], &v = velocity[1];
  for (int z = 0; z < domain.cells.z; ++z) {
    for (int y = 0; y < domain.cells.y; ++y) u(0, y, z) = u(domain.cells.x, y, z) = 0;
    for (int x = 0; x < domain.cells.x; ++x) v(x, 0, z) = v(x, domain.cells.y, z) = 0;
  }
  return velocity;
}

FluidProblem taylor_green(int cells, double viscosity, int dimensions) {
  const FluidDomain domain =
      box_domain({cells, cells, thickness(dimensions, cells)}, pi / cells, WallKind::free_slip);
  FluidProblem problem =
      problem_in(domain, {.method = FluidMethod::central, .viscosity = viscosity});
  problem.initial.velocity = taylor_green_velocity(domain, viscosity, 0);
  return problem;
}

FluidProblem couette_start(int cells, double viscosity) {
  FluidDomain domain = channel(cells);
  domain.walls[3].velocity = {1, 0, 0};
  return problem_in(domain, {.method = FluidMethod::central, .viscosity = viscosity});
}

double couette_speed(double viscosity, double time, double y) {
  double speed = y;
  for (int n = 1; n < 2000; ++n) {
    const double decay = std::exp(-n * n * pi * pi * viscosity * time);
    if (decay < 1e-18) break;
    speed += 2 / (n * pi) * (n % 2 == 0 ? 1 : -1) * decay * std::sin(n * pi * y);
  }
  return speed;
}

FluidProblem poiseuille(int cells, double viscosity) {
  FluidProblem problem =
      problem_in(channel(cells), {.method = FluidMethod::central, .viscosity = viscosity});
  problem.parameters.force = {8 * viscosity, 0, 0};
  problem.duration = 1 / viscosity;
  return problem;
}

FluidProblem hydrostatic_liquid(int cells, int dimensions) {
  const int width = std::max(cells / 2, 1);
  const FluidDomain domain = box_domain({width, cells + cells / 2, thickness(dimensions, width)},
                                        1.0 / cells, WallKind::free_slip);
  FluidProblem problem =
      problem_in(domain, {.method = FluidMethod::flip, .density = 1000, .force = {0, -9.81, 0}});
  add_liquid(problem, dvec3(0),
             {domain.cells.x * domain.spacing, 1, domain.cells.z * domain.spacing});
  return problem;
}

FluidProblem hydrostatic_box(int cells, int dimensions) {
  const int width = std::max(cells / 2, 1);
  const FluidDomain domain =
      box_domain({width, cells, thickness(dimensions, width)}, 1.0 / cells, WallKind::no_slip);
  return problem_in(domain, {.method = FluidMethod::maccormack,
                             .density = 1000,
                             .viscosity = 1e-6,
                             .force = {0, -9.81, 0}});
}

FluidProblem smoke_plume(int cells, int dimensions) {
  const FluidDomain domain = box_domain({cells, 2 * cells, thickness(dimensions, cells)},
                                        1.0 / cells, WallKind::free_slip);
  FluidProblem problem = problem_in(domain, {.method = FluidMethod::maccormack,
                                             .density = 1.2,
                                             .heat_lift = 0.05,
                                             .smoke_weight = 0.2,
                                             .cooling = 0.1,
                                             .vorticity_confinement = 0.2,
                                             .courant = 2,
                                             .divergence = 1e-2});
  const double middle = 0.5 * domain.cells.z * domain.spacing;
  problem.solids.push_back({.center = {0.5, 1.0, middle}, .half = dvec3(0.15)});
  problem.sources.push_back(
      {.center = {0.5, 0.18, middle}, .radius = 0.11, .smoke = 1, .temperature = 60});
  problem.duration = 4;
  return problem;
}

void add_liquid(FluidProblem& problem, dvec3 low, dvec3 high) {
  const FluidDomain& domain = problem.domain;
  const ivec3 per_cell = domain.is_flat() ? ivec3(2, 2, 1) : ivec3(2);
  LiquidParticles& particles = problem.initial.particles;
  const ivec3 count = domain.cells * per_cell;
  for (int z = 0; z < count.z; ++z)
    for (int y = 0; y < count.y; ++y)
      for (int x = 0; x < count.x; ++x) {
        const dvec3 p = domain.origin + domain.spacing * (dvec3(x, y, z) + 0.5) / dvec3(per_cell);
        if (glm::any(glm::lessThan(p, low)) || glm::any(glm::greaterThan(p, high))) continue;
        if (solid_distance(problem.solids, problem.initial.time, p) < 0) continue;
        particles.positions.push_back(vec3(p));
      }
  particles.velocities.resize(particles.count(), vec3(0));
  particles.gradients.resize(particles.count(), mat3(0));
}

FluidProblem dam_break(int cells, double width, int dimensions) {
  const double spacing = width / cells;
  const FluidDomain domain = box_domain({5 * cells, 3 * cells, thickness(dimensions, cells)},
                                        spacing, WallKind::free_slip);
  FluidProblem problem =
      problem_in(domain, {.method = FluidMethod::flip, .density = 1000, .force = {0, -9.81, 0}});
  add_liquid(problem, dvec3(0), {width, 2 * width, domain.cells.z * spacing});
  problem.duration = 4 * std::sqrt(width / (2 * 9.81));
  return problem;
}

FluidProblem double_dam_break(int cells, int dimensions) {
  const double spacing = 1.0 / cells;
  const FluidDomain domain = box_domain({4 * cells, 2 * cells, thickness(dimensions, 2 * cells)},
                                        spacing, WallKind::free_slip);
  FluidProblem problem =
      problem_in(domain, {.method = FluidMethod::apic, .density = 1000, .force = {0, -9.81, 0}});
  const double depth = domain.cells.z * spacing;
  problem.solids.push_back({.shape = SolidShape::box,
                            .center = {2, 0.2, depth / 2},
                            .half = {0.3, 0.2, dimensions == 2 ? depth : depth / 4}});
  add_liquid(problem, dvec3(0), {0.8, 1.4, depth});
  add_liquid(problem, {3.2, 0, 0}, {4, 1.4, depth});
  problem.duration = 2;
  return problem;
}

FluidProblem random_fluid(std::uint64_t seed) {
  Random random(seed, 77);
  const ivec3 cells(8 + 2 * int(random.below(9)), 8 + int(random.below(17)), 1);
  FluidDomain domain = box_domain(cells, 1.0 / cells.x, WallKind(random.below(2)));
  if (random.below(3) == 0) domain.walls[0].kind = domain.walls[1].kind = WallKind::periodic;
  if (random.below(3) == 0) domain.walls[3].kind = WallKind::open;
  if (domain.walls[2].kind == WallKind::no_slip)
    domain.walls[2].velocity = {random.uniform(-2, 2), 0, 0};
  FluidProblem problem = problem_in(domain, {.method = FluidMethod(random.below(6))});
  FluidParameters& p = problem.parameters;
  p.density = std::pow(10.0, random.uniform(-1, 3));
  p.viscosity = random.below(4) == 0 ? 0 : std::pow(10.0, random.uniform(-5, 0));
  p.implicit_viscosity = random.below(2) == 1;
  p.force = {random.uniform(-5, 5), random.uniform(-10, 0), 0};
  if (random.below(2) == 0)
    problem.solids.push_back({.shape = SolidShape(random.below(2)),
                              .center = {random.uniform(0.3f, 0.7f), random.uniform(0.3f, 0.5f), 0},
                              .half = {0.15, 0.1, 1},
                              .velocity = {random.uniform(-0.2f, 0.2f), 0, 0}});
  for (std::size_t axis = 0; axis < 2; ++axis)
    for (double& value : problem.initial.velocity[axis].values) value = random.uniform(-1, 1);
  // The first and the last face of a periodic axis are one.
  if (domain.is_periodic(0)) {
    Field& u = problem.initial.velocity[0];
    for (int y = 0; y < cells.y; ++y) u(cells.x, y, 0) = u(0, y, 0);
  }
  if (is_liquid(p.method))
    add_liquid(problem, dvec3(0), {0.6, 0.6 * cells.y * domain.spacing, domain.spacing});
  problem.duration = 0.5;
  return problem;
}

}  // namespace parity
