#include <algorithm>
#include <cmath>

#include "geometry/random.h"
#include "sim/sph.h"

namespace parity {
namespace {

constexpr double earth = 9.81;

/// A box that is flat in 2 dimensions.
SphBox box_of(std::uint32_t dimensions, const dvec3& low, const dvec3& high) {
  SphBox box{low, high};
  if (dimensions == 2) box.low.z = box.high.z = 0;
  return box;
}

/// Twice the spacing, and a speed of sound of ten times that of free fall from `height`.
SphParameters parameters_for(std::uint32_t dimensions, double spacing, double height) {
  SphParameters p;
  p.dimensions = dimensions;
  p.spacing = spacing;
  p.support = 2 * spacing;
  p.sound_speed = 10 * std::sqrt(2 * earth * height);
  return p;
}

void append(std::vector<vec3>& points, const std::vector<vec3>& more) {
  points.insert(points.end(), more.begin(), more.end());
}

void add_fluid(SphProblem& problem, const SphBox& box, const dvec3& velocity) {
  append(problem.initial.positions,
         fill_box(box, problem.parameters.spacing, problem.parameters.dimensions));
  problem.initial.velocities.resize(problem.initial.positions.size(), vec3(velocity));
}

SphProblem tank(const SphParameters& parameters, const SphBox& domain) {
  SphProblem problem{.parameters = parameters, .domain = domain};
  problem.boundary = cover_box(domain, parameters.spacing, parameters.dimensions, true, true);
  return problem;
}

}  // namespace

SphProblem sph_dam_break(std::uint32_t dimensions, double width, int count) {
  const double spacing = width / count;
  const SphParameters p = parameters_for(dimensions, spacing, 2 * width);
  SphProblem problem = tank(p, box_of(dimensions, dvec3(0), dvec3(5 * width, 3 * width, width)));
  add_fluid(problem, box_of(dimensions, dvec3(0), dvec3(width, 2 * width, width)), dvec3(0));
  problem.parameters.artificial_viscosity = 0.2;
  problem.duration = 3 * std::sqrt(width / (2 * earth));
  return problem;
}

SphProblem sph_hydrostatic_column(std::uint32_t dimensions, double width, double height,
                                  int count) {
  const double spacing = height / count;
  const SphParameters p = parameters_for(dimensions, spacing, height);
  SphProblem problem = tank(p, box_of(dimensions, dvec3(0), dvec3(width, 1.5 * height, width)));
  add_fluid(problem, box_of(dimensions, dvec3(0), dvec3(width, height, width)), dvec3(0));
  // Compressed by its own weight, or it would bounce.
  const double strain = earth / (p.sound_speed * p.sound_speed);
  for (vec3& at : problem.initial.positions) at.y -= float(strain * at.y * (height - at.y / 2));
  problem.duration = 4 * std::sqrt(2 * height / earth);
  return problem;
}

SphProblem sph_double_dam_break(std::uint32_t dimensions, int count) {
  const double spacing = 1.0 / count;
  const SphParameters p = parameters_for(dimensions, spacing, 1);
  SphProblem problem = tank(p, box_of(dimensions, dvec3(0), dvec3(4, 2, 1)));
  add_fluid(problem, box_of(dimensions, dvec3(0), dvec3(0.8, 1, 1)), dvec3(0));
  add_fluid(problem, box_of(dimensions, dvec3(3.2, 0, 0), dvec3(4, 1, 1)), dvec3(0));
  const SphBox block = box_of(dimensions, dvec3(1.8, 0, 0.3), dvec3(2.2, 0.4, 0.7));
  append(problem.boundary, cover_box(block, spacing, dimensions, false, false));
  problem.duration = 3;
  return problem;
}

SphProblem sph_random_drop(std::uint32_t dimensions, int count, double speed, std::uint64_t seed) {
  SphProblem problem;
  SphParameters& p = problem.parameters;
  p = parameters_for(dimensions, 1.0 / count, 1);
  p.gravity = dvec3(0);
  p.surface_tension = 10;
  problem.domain = box_of(dimensions, dvec3(-1), dvec3(1));
  const SphBox box = box_of(dimensions, dvec3(-0.5), dvec3(0.5));
  add_fluid(problem, box, dvec3(0));
  Random random{seed};
  for (std::size_t i = 0; i < problem.initial.positions.size(); ++i) {
    vec3 shift = random.in_box(float(0.1 * p.spacing));
    vec3 velocity = random.in_box(float(speed));
    if (dimensions == 2) shift.z = velocity.z = 0;
    problem.initial.positions[i] += shift;
    problem.initial.velocities[i] = velocity;
  }
  return problem;
}

SphProblem sph_random_scene(std::uint64_t seed) {
  Random random{seed};
  const auto pick = [&](double low, double high) {
    return double(random.uniform(float(low), float(high)));
  };
  const double spacing = std::pow(10.0, pick(-2.5, -1));
  const dvec3 sides = spacing * dvec3(20 + random.below(30), 20 + random.below(20), 0);
  SphParameters p = parameters_for(2, spacing, sides.y);
  constexpr SphKernel kernels[] = {SphKernel::cubic_spline, SphKernel::spiky, SphKernel::wendland};
  p.kernel = kernels[random.below(3)];
  p.support = spacing * pick(2, 2.6);
  p.equation_of_state = SphEquationOfState(random.below(2));
  p.sound_speed *= pick(0.5, 2);
  p.artificial_viscosity = pick(0.02, 0.5);
  p.viscosity = random.below(2) * p.sound_speed * spacing * std::pow(10.0, pick(-4, 0));
  p.surface_tension = random.below(2) * pick(0, 1) * earth / spacing;
  p.gravity = earth * dvec3(pick(-0.5, 0.5), pick(-1, 0.2), 0);
  SphProblem problem = tank(p, box_of(2, dvec3(0), sides));
  const std::uint32_t blocks = 1 + random.below(3);
  const double room = sides.x / blocks;
  for (std::uint32_t k = 0; k < blocks; ++k) {
    const dvec3 size = spacing * dvec3(2 + random.below(std::uint32_t(room / spacing) - 3),
                                       2 + random.below(std::uint32_t(sides.y / spacing) - 3), 0);
    const dvec3 low{room * k, spacing * random.below(2), 0};
    const double speed = 0.1 * p.sound_speed;
    add_fluid(problem, {low, low + size}, dvec3(pick(-speed, speed), pick(-speed, speed), 0));
  }
  problem.duration = 100 * spacing / p.sound_speed;
  return problem;
}

}  // namespace parity
