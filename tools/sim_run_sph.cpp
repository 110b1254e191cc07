#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "cpu_reference/sph/density.h"
#include "cpu_reference/sph/neighbours.h"
#include "cpu_reference/sph/step.h"
#include "gpu/sph/step.h"
#include "tools/sim_bytes.h"
#include "tools/sim_run_methods.h"

namespace parity::tools {
namespace {

/// Particles half a spacing inside a ball, evenly spread along a spiral.
/// Source: Gonzalez 2010, "Measurement of areas on a sphere using Fibonacci and latitude-longitude
/// lattices".
std::vector<vec3> cover_ball(const SimShape& ball, double spacing, int dimensions) {
  const double pi = std::numbers::pi, r = std::max(ball.radius - 0.5 * spacing, 0.5 * spacing);
  const auto count = std::max<std::size_t>(
      6, std::size_t(dimensions == 2 ? 2 * pi * r / spacing : 4 * pi * r * r / spacing / spacing));
  std::vector<vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double part = (double(i) + 0.5) / double(count);
    if (dimensions == 2) {
      points.push_back(
          vec3(ball.center + r * dvec3(std::cos(2 * pi * part), std::sin(2 * pi * part), 0)));
      continue;
    }
    const double height = 1 - 2 * part, around = std::sqrt(1 - height * height);
    const double angle = pi * (3 - std::sqrt(5.0)) * double(i);
    points.push_back(
        vec3(ball.center + r * dvec3(around * std::cos(angle), height, around * std::sin(angle))));
  }
  return points;
}

void append(std::vector<vec3>& points, const std::vector<vec3>& more) {
  points.insert(points.end(), more.begin(), more.end());
}

/// Is there an earlier body of liquid or a solid at a place?
bool is_taken(const SimScene& scene, std::size_t liquid, const dvec3& p) {
  const auto holds = [&](const SimBody& body) { return contains(body.shape, p); };
  return std::any_of(scene.liquid.begin(), scene.liquid.begin() + std::ptrdiff_t(liquid), holds) ||
         std::ranges::any_of(scene.solids, holds);
}

/// Is a place less than half a spacing, but for rounding, from a side of the domain? A particle
/// there would start compressed against the wall.
bool is_pressed(const SimScene& scene, const dvec3& p) {
  for (int d = 0; d < scene.dimensions; ++d)
    if (std::min(p[d], scene.size[d] - p[d]) < 0.49 * scene.spacing) return true;
  return false;
}

void add_liquid(const SimScene& scene, std::size_t index, SphProblem& problem) {
  const SimBody& body = scene.liquid[index];
  const bool is_ball = body.shape.kind == SimShape::Kind::sphere;
  SphBox box{body.shape.low, body.shape.high};
  if (is_ball) box = {body.shape.center - body.shape.radius, body.shape.center + body.shape.radius};
  if (scene.dimensions == 2) box.low.z = box.high.z = 0;
  for (const vec3& p : fill_box(box, scene.spacing, problem.parameters.dimensions)) {
    const dvec3 at(p);
    if ((is_ball && !contains(body.shape, at)) || is_pressed(scene, at) ||
        is_taken(scene, index, at))
      continue;
    problem.initial.positions.push_back(p);
    problem.initial.velocities.push_back(vec3(body.velocity));
  }
}

/// Ten times the speed of a fall from the highest liquid.
double sound_speed_of(const SimScene& scene) {
  double top = scene.spacing, fastest = 0;
  for (const SimBody& body : scene.liquid) {
    top = std::max({top, body.shape.high.y, body.shape.center.y + body.shape.radius});
    fastest = std::max(fastest, glm::length(body.velocity));
  }
  return 10 * std::max({std::sqrt(2 * glm::length(scene.gravity) * top), fastest, 0.1});
}

/// Velocity and share of the viscosity of a wall particle: of the side that it stands outside of,
/// of several the first that does not slip; solids do not slip.
vec4 wall_motion(const SimScene& scene, const vec3& wall) {
  bool is_outside = false;
  for (int side = 0; side < 2 * scene.dimensions; ++side) {
    const double at = double(wall[side / 2]);
    if (side % 2 == 0 ? at > 0 : at < scene.size[side / 2]) continue;
    is_outside = true;
    if (scene.sides[side].kind == SimSideKind::no_slip)
      return vec4(vec3(scene.sides[side].velocity), 1);
  }
  return vec4(0, 0, 0, is_outside ? 0 : 1);
}

SphProblem problem_of(const SimScene& scene) {
  SphProblem problem;
  SphParameters& p = problem.parameters;
  p.dimensions = std::uint32_t(scene.dimensions);
  p.spacing = scene.spacing;
  p.support = 2 * scene.spacing;
  p.method = scene.method == SimMethod::wcsph ? SphMethod::weakly_compressible
                                              : SphMethod::divergence_free;
  p.rest_density = scene.fluid.density;
  p.sound_speed = scene.solver.sound_speed.value_or(sound_speed_of(scene));
  p.artificial_viscosity = scene.solver.artificial_viscosity;
  p.viscosity = scene.fluid.viscosity;
  p.implicit_viscosity = scene.solver.implicit_viscosity;
  p.surface_tension = scene.fluid.surface_tension;
  p.gravity = scene.gravity;
  p.courant = scene.solver.courant.value_or(p.courant);
  p.max_step = scene.solver.max_step.value_or(p.max_step);
  p.density_error = scene.solver.density_error;
  problem.domain = {dvec3(0), scene.size};
  if (scene.dimensions == 2) problem.domain.high.z = 0;
  problem.duration = scene.duration;
  problem.boundary = cover_box(problem.domain, p.spacing, p.dimensions, true,
                               scene.sides[3].kind == SimSideKind::open);
  for (const SimBody& solid : scene.solids)
    append(problem.boundary, solid.shape.kind == SimShape::Kind::box
                                 ? cover_box({solid.shape.low, solid.shape.high}, p.spacing,
                                             p.dimensions, false, false)
                                 : cover_ball(solid.shape, p.spacing, scene.dimensions));
  for (const vec3& wall : problem.boundary)
    problem.boundary_motions.push_back(wall_motion(scene, wall));
  for (std::size_t i = 0; i < scene.liquid.size(); ++i) add_liquid(scene, i, problem);
  if (problem.initial.positions.empty())
    throw std::invalid_argument("liquid: holds no particle: too thin, or solids take its room");
  check_sph_problem(problem);
  return problem;
}

SimContent content_of(const SphParameters& parameters, SphState state,
                      const std::vector<float>& densities) {
  SimContent content;
  content.time = state.time;
  content.positions = std::move(state.positions);
  content.velocities = std::move(state.velocities);
  content.pressures = std::move(state.pressures);
  if (parameters.method != SphMethod::weakly_compressible) return content;
  content.pressures.clear();
  for (const float density : densities)
    content.pressures.push_back(float(cpu::sph_pressure(parameters, double(density))));
  return content;
}

SimMeasures measures_of(const SphParameters& parameters, const SphState& state,
                        const std::vector<float>& densities) {
  const SphMeasures m = measure(parameters, state);
  const SphDensityError error = density_error(parameters, densities);
  return {.time = state.time,
          .mass = m.mass,
          .momentum = m.momentum,
          .kinetic_energy = m.kinetic_energy,
          .potential_energy = m.potential_energy,
          .max_speed = m.max_speed,
          .divergence = std::nan(""),
          .density_error = error.average,
          .max_density_error = error.largest};
}

std::string save_state(const SphState& state) {
  ByteWriter writer;
  writer.value(state.time);
  writer.list(state.positions);
  writer.list(state.velocities);
  std::vector<float> pressures = state.pressures;
  pressures.resize(state.positions.size());
  writer.list(pressures);
  return writer.take();
}

SphState restore_state(std::string_view bytes, std::size_t count) {
  ByteReader reader(bytes);
  SphState state;
  state.time = reader.value<double>();
  if (!(state.time >= 0 && state.time < 1e9)) throw std::runtime_error("has a wrong time");
  state.positions = reader.list<vec3>(count, "positions");
  state.velocities = reader.list<vec3>(count, "velocities");
  state.pressures = reader.list<float>(count, "pressures");
  if (!reader.is_at_end()) throw std::runtime_error("goes on after its end");
  return state;
}

}  // namespace

Simulation start_sph_on_device(const SimScene& scene, gpu::Context& context) {
  constexpr int steps_at_once = 8;
  const SphProblem problem = problem_of(scene);
  const auto stepper = std::make_shared<gpu::SphStep>(context, problem);
  const SphParameters parameters = problem.parameters;
  const std::size_t count = problem.initial.positions.size();
  Simulation s;
  s.device = context.info().name + ", " + context.info().driver;
  s.particles = count;
  s.time = [stepper] { return stepper->report().time; };
  s.has_reached = [stepper](double until) {  // the clock is the sum of two floats
    const double high = double(float(until));
    return stepper->report().time >= high + double(float(until - high));
  };
  s.step = [stepper, &context](double until) {
    const std::uint32_t before = stepper->report().steps;
    context.run([&](gpu::Commands& commands) {
      for (int i = 0; i < steps_at_once; ++i) stepper->record(commands, until);
    });
    const gpu::SphReport report = stepper->report();
    if (report.crowded > 0)
      throw std::runtime_error("particles are crowded beyond their lists at " +
                               std::to_string(report.time) + " s: the run is unstable");
    return std::uint64_t(report.steps - before);
  };
  s.measures = [stepper, parameters] {
    return measures_of(parameters, stepper->read(), stepper->densities().read());
  };
  s.content = [stepper, parameters] {
    return content_of(parameters, stepper->read(), stepper->densities().read());
  };
  s.save = [stepper] { return save_state(stepper->read()); };
  s.restore = [stepper, count](std::string_view bytes) {
    stepper->write(restore_state(bytes, count));
  };
  return s;
}

Simulation start_sph_on_host(const SimScene& scene) {
  const auto problem = std::make_shared<SphProblem>(problem_of(scene));
  const SphParameters parameters = problem->parameters;
  SphParameters waves = parameters;  // incompressible fluids have none
  if (parameters.method != SphMethod::weakly_compressible) waves.sound_speed = 0;
  const double held =
      0.25 * std::sqrt(parameters.support / 2 / std::max(glm::length(parameters.gravity), 1e-9));
  const double stable =
      std::min({parameters.courant * cpu::sph_stable_step(waves), parameters.max_step, held});
  Simulation s;
  s.device = "CPU reference";
  s.particles = problem->initial.positions.size();
  s.time = [problem] { return problem->initial.time; };
  s.has_reached = [problem](double until) { return problem->initial.time >= until; };
  s.step = [problem, parameters, stable](double until) {
    const double speed = measure(parameters, problem->initial).max_speed;
    const double step = std::min(stable, parameters.courant * parameters.spacing / (speed + 1e-9));
    const double left = until - problem->initial.time;
    problem->initial = cpu::sph_step(*problem, std::min(step, left), 1);
    if (step >= left) problem->initial.time = until;
    return std::uint64_t(1);
  };
  const auto densities = [problem] {
    const SphNeighbourLists lists = cpu::sph_neighbours(
        problem->initial.positions, problem->boundary, float(problem->parameters.support));
    const std::vector<double> exact = cpu::sph_densities(*problem, lists);
    return std::vector<float>(exact.begin(), exact.end());
  };
  s.measures = [problem, parameters, densities] {
    return measures_of(parameters, problem->initial, densities());
  };
  s.content = [problem, parameters, densities] {
    return content_of(parameters, problem->initial, densities());
  };
  s.save = [problem] { return save_state(problem->initial); };
  s.restore = [problem](std::string_view bytes) {
    problem->initial = restore_state(bytes, problem->initial.positions.size());
  };
  return s;
}

}  // namespace parity::tools
