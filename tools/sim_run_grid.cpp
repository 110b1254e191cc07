#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "cpu_reference/fluid/adapt.h"
#include "cpu_reference/fluid/liquid.h"
#include "cpu_reference/fluid/step.h"
#include "gpu/fluid/adapt.h"
#include "gpu/fluid/step.h"
#include "tools/sim_bytes.h"
#include "tools/sim_run_methods.h"

namespace parity::tools {
namespace {

FluidMethod method_of(const SimScene& scene) {
  if (scene.method == SimMethod::flip) return FluidMethod::flip;
  if (scene.method == SimMethod::apic) return FluidMethod::apic;
  switch (scene.solver.advection) {
    case SimAdvection::upwind:
      return FluidMethod::upwind;
    case SimAdvection::central:
      return FluidMethod::central;
    case SimAdvection::semi_lagrangian:
      return FluidMethod::semi_lagrangian;
    default:
      return FluidMethod::maccormack;
  }
}

WallKind wall_of(SimSideKind kind) {
  switch (kind) {
    case SimSideKind::no_slip:
      return WallKind::no_slip;
    case SimSideKind::open:
      return WallKind::open;
    case SimSideKind::periodic:
      return WallKind::periodic;
    default:
      return WallKind::free_slip;
  }
}

FluidDomain domain_of(const SimScene& scene) {
  FluidDomain domain{.cells = cells_of(scene), .spacing = scene.spacing};
  for (int side = 0; side < 6; ++side) {
    domain.walls[std::size_t(side)] = {wall_of(scene.sides[side].kind), scene.sides[side].velocity};
    if (scene.dimensions == 2 && side >= 4) domain.walls[std::size_t(side)] = {WallKind::free_slip};
  }
  if (scene.dimensions == 2) domain.origin.z = -0.5 * scene.spacing;  // shapes lie at z = 0
  return domain;
}

FluidParameters parameters_of(const SimScene& scene) {
  FluidParameters p;
  p.method = method_of(scene);
  p.density = scene.fluid.density;
  p.viscosity = scene.fluid.viscosity;
  if (is_liquid(p.method)) p.force = scene.gravity;
  p.heat_lift = -scene.fluid.expansion * scene.gravity.y;
  p.smoke_weight = scene.fluid.smoke_weight;
  p.cooling = scene.fluid.cooling;
  p.vorticity_confinement = scene.fluid.vorticity_confinement;
  p.flip_ratio = scene.solver.flip_ratio;
  p.courant = scene.solver.courant.value_or(p.courant);
  p.max_step = scene.solver.max_step.value_or(p.max_step);
  p.step_error = scene.solver.error.value_or(0);
  p.divergence = scene.solver.divergence;
  p.sparse = scene.solver.sparse;
  return p;
}

/// Particles on the lattice of its bounding box, without those outside the body or in what stands
/// there already.
void add_body(const SimScene& scene, std::size_t index, FluidProblem& problem) {
  const SimBody& body = scene.liquid[index];
  const SimShape& shape = body.shape;
  dvec3 low = shape.low, high = shape.high;
  if (shape.kind == SimShape::Kind::sphere) {
    low = shape.center - shape.radius;
    high = shape.center + shape.radius;
  }
  const FluidDomain& domain = problem.domain;
  const dvec3 end = domain.origin + domain.spacing * dvec3(domain.cells);
  if (domain.is_flat()) low.z = domain.origin.z, high.z = end.z;
  LiquidParticles before = std::move(problem.initial.particles);
  problem.initial.particles = {};
  add_liquid(problem, glm::max(low, domain.origin), glm::min(high, end));
  for (vec3 p : problem.initial.particles.positions) {
    dvec3 at{p};
    if (domain.is_flat()) at.z = 0;
    const auto holds = [&](const SimBody& other) { return contains(other.shape, at); };
    if ((shape.kind == SimShape::Kind::sphere && !contains(shape, at)) ||
        std::any_of(scene.liquid.begin(), scene.liquid.begin() + std::ptrdiff_t(index), holds) ||
        std::ranges::any_of(scene.solids, holds))
      continue;
    before.positions.push_back(p);
    before.velocities.push_back(vec3(body.velocity));
    before.gradients.push_back(mat3(0));
  }
  problem.initial.particles = std::move(before);
}

FluidProblem problem_of(const SimScene& scene) {
  FluidProblem problem{.domain = domain_of(scene), .parameters = parameters_of(scene)};
  problem.initial = resting_state(problem.domain);
  problem.duration = scene.duration;
  for (const SimBody& solid : scene.solids) {
    const SimShape& s = solid.shape;
    const bool is_box = s.kind == SimShape::Kind::box;
    FluidSolid f{.shape = is_box ? SolidShape::box : SolidShape::sphere,
                 .center = is_box ? 0.5 * (s.low + s.high) : s.center,
                 .half = is_box ? 0.5 * (s.high - s.low) : dvec3(s.radius),
                 .velocity = solid.velocity};
    if (is_box && scene.dimensions == 2) f.half.z = scene.spacing;
    problem.solids.push_back(f);
  }
  for (const SimSource& s : scene.sources)
    problem.sources.push_back({s.center, s.radius, s.smoke, s.temperature, s.velocity});
  for (std::size_t i = 0; i < scene.liquid.size(); ++i) add_body(scene, i, problem);
  if (is_liquid(problem.parameters.method) && problem.initial.particles.positions.empty())
    throw std::invalid_argument("liquid: holds no particle: too thin, or solids take its room");
  if (scene.start == SimStart::taylor_green)
    problem.initial.velocity =
        taylor_green_velocity(problem.domain, problem.parameters.viscosity, 0);
  check_fluid_problem(problem);
  return problem;
}

std::vector<float> floats_of(const Field& field) {
  return {field.values.begin(), field.values.end()};
}

/// Velocities at the centres of cells: means of opposite faces.
std::vector<vec3> center_flow(const FluidDomain& domain, const FaceFields& velocity) {
  std::vector<vec3> flow(domain.cell_count());
  std::size_t i = 0;
  for (int z = 0; z < domain.cells.z; ++z)
    for (int y = 0; y < domain.cells.y; ++y)
      for (int x = 0; x < domain.cells.x; ++x, ++i)
        for (int a = 0; a < 3; ++a) {
          const ivec3 low{x, y, z};
          const Field& f = velocity[std::size_t(a)];
          flow[i][a] = float(0.5 * (f(low) + f(low + axis_step(a))));
        }
  return flow;
}

SimContent content_of(const FluidProblem& problem, const FluidState& state) {
  SimContent content;
  content.time = state.time;
  content.positions = state.particles.positions;
  content.velocities = state.particles.velocities;
  content.cells = problem.domain.cells;
  content.spacing = float(problem.domain.spacing);
  content.flow = center_flow(problem.domain, state.velocity);
  content.pressure = floats_of(state.pressure);
  content.smoke = floats_of(state.smoke);
  content.temperature = floats_of(state.temperature);
  if (problem.solids.empty()) return content;
  for (int z = 0; z < content.cells.z; ++z)
    for (int y = 0; y < content.cells.y; ++y)
      for (int x = 0; x < content.cells.x; ++x) {
        const double distance = solid_distance(problem.solids, state.time,
                                               point_position(problem.domain, -1, {x, y, z}));
        content.solid.push_back(distance < 0 ? 1.0f : 0.0f);
      }
  return content;
}

SimMeasures measures_of(const FluidProblem& problem, const FluidState& state) {
  const FluidMeasures m = measure(problem, state);
  double potential = 0;
  if (!state.particles.positions.empty()) {
    dvec3 sum{0};
    for (const vec3& p : state.particles.positions) sum += dvec3(p);
    potential = -liquid_particle_mass(problem) * glm::dot(problem.parameters.force, sum);
  }
  return {.time = state.time,
          .mass = m.mass,
          .momentum = m.momentum,
          .kinetic_energy = m.kinetic_energy,
          .potential_energy = potential,
          .max_speed = m.max_speed,
          .divergence = m.divergence,
          .density_error = std::nan(""),
          .max_density_error = std::nan("")};
}

/// All numbers of the device are floats; the reference's are not, and keep their bits.
template <typename Number>
std::string save_state(const FluidState& state, const StepControl& control) {
  ByteWriter writer;
  const auto field = [&](const Field& f) {
    writer.list(std::vector<Number>(f.values.begin(), f.values.end()));
  };
  writer.value(state.time);
  writer.value(state.steps);
  for (const Field& f : state.velocity) field(f);
  for (const Field* f : {&state.pressure, &state.smoke, &state.temperature}) field(*f);
  writer.list(state.particles.positions);
  writer.list(state.particles.velocities);
  writer.list(state.particles.gradients);
  writer.value(control);
  return writer.take();
}

template <typename Number>
FluidState restore_state(std::string_view bytes, const FluidProblem& problem,
                         StepControl& control) {
  ByteReader reader(bytes);
  FluidState state = problem.initial;
  const auto field = [&](Field& f, const char* what) {
    const std::vector<Number> values = reader.list<Number>(f.values.size(), what);
    f.values.assign(values.begin(), values.end());
  };
  state.time = reader.value<double>();
  if (!(state.time >= 0 && state.time < 1e9)) throw std::runtime_error("has a wrong time");
  state.steps = reader.value<std::uint32_t>();
  for (Field& f : state.velocity) field(f, "velocities");
  field(state.pressure, "pressures");
  field(state.smoke, "values of smoke");
  field(state.temperature, "temperatures");
  LiquidParticles& p = state.particles;
  p.positions = reader.list<vec3>(p.positions.size(), "positions");
  p.velocities = reader.list<vec3>(p.velocities.size(), "velocities of particles");
  p.gradients = reader.list<mat3>(p.gradients.size(), "gradients");
  control = reader.value<StepControl>();
  if (!(control.allowed >= 0 && control.allowed < 1e9))
    throw std::runtime_error("has a wrong step");
  if (!reader.is_at_end()) throw std::runtime_error("goes on after its end");
  return state;
}

}  // namespace

Simulation start_grid_on_device(const SimScene& scene, gpu::Context& context) {
  const auto problem = std::make_shared<const FluidProblem>(problem_of(scene));
  const auto fluid = std::make_shared<gpu::FluidSimulation>(context, *problem);
  Simulation s;
  s.device = context.info().name + ", " + context.info().driver;
  s.particles = problem->initial.particles.count();
  s.cells = problem->domain.cell_count();
  s.time = [fluid] { return double(fluid->clock().time); };
  s.has_reached = [fluid](double until) { return fluid->clock().time >= float(until); };
  const auto control = std::make_shared<StepControl>();
  if (problem->parameters.step_error > 0) {
    const auto adaptive =
        std::make_shared<gpu::AdaptiveFluid>(context, *fluid, problem->parameters);
    s.refused = [control] { return std::uint64_t(control->refused); };
    s.step = [adaptive, fluid, control](double until) {
      return std::uint64_t(adaptive->step(*control, until));
    };
  } else {
    s.step = [fluid, &context](double until) {
      const std::uint32_t before = fluid->clock().steps;
      fluid->set_end(until);  // one step: none may follow the last of a frame
      context.run([&](gpu::Commands& commands) { fluid->record_step(commands); });
      return std::uint64_t(fluid->clock().steps - before);
    };
  }
  s.measures = [fluid, problem] { return measures_of(*problem, fluid->read()); };
  s.content = [fluid, problem] { return content_of(*problem, fluid->read()); };
  s.save = [fluid, control] { return save_state<float>(fluid->read(), *control); };
  s.restore = [fluid, problem, control](std::string_view bytes) {
    fluid->write(restore_state<float>(bytes, *problem, *control));
  };
  return s;
}

Simulation start_grid_on_host(const SimScene& scene) {
  const auto problem = std::make_shared<const FluidProblem>(problem_of(scene));
  const auto state = std::make_shared<FluidState>(problem->initial);
  Simulation s;
  s.device = "CPU reference";
  s.particles = problem->initial.particles.count();
  s.cells = problem->domain.cell_count();
  s.time = [state] { return state->time; };
  s.has_reached = [state](double until) { return state->time >= until; };
  const auto control = std::make_shared<StepControl>();
  const bool is_by_error = problem->parameters.step_error > 0;
  if (is_by_error) s.refused = [control] { return std::uint64_t(control->refused); };
  s.step = [state, problem, control, is_by_error](double until) {
    if (is_by_error) {
      *state = cpu::adaptive_step(*problem, *state, *control, until);
      return std::uint64_t(1);
    }
    const double step = cpu::stable_step(*problem, *state), left = until - state->time;
    *state = is_liquid(problem->parameters.method)
                 ? cpu::liquid_step(*problem, *state, std::min(step, left))
                 : cpu::step(*problem, *state, std::min(step, left));
    if (step >= left) state->time = until;
    return std::uint64_t(1);
  };
  s.measures = [state, problem] { return measures_of(*problem, *state); };
  s.content = [state, problem] { return content_of(*problem, *state); };
  s.save = [state, control] { return save_state<double>(*state, *control); };
  s.restore = [state, problem, control](std::string_view bytes) {
    *state = restore_state<double>(bytes, *problem, *control);
  };
  return s;
}

}  // namespace parity::tools
