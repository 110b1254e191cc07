#include "gpu/fluid/step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gpu/fluid/liquid.h"
#include "shaders.h"

namespace parity::gpu {
namespace {

enum class Smoke : std::uint32_t { sources, vorticity, spin, forces };
constexpr std::uint32_t speed_chunks = 256;  ///< that the largest speed of an axis is found in
constexpr int implicit_sweeps = 64;          ///< contract by (10 / 11)^2 each, fluid/clock.comp

std::uint32_t speed_run(std::uint32_t faces) { return (faces + speed_chunks - 1) / speed_chunks; }

std::vector<Kernel<FluidScalarArgs>> make_smoke_steps(Context& context, FluidMethod method,
                                                      Specialization tiled) {
  std::vector<Kernel<FluidScalarArgs>> steps;
  if (is_split(method))
    for (std::uint32_t mode = 0; mode < 4; ++mode)
      steps.emplace_back(context, shaders::fluid_smoke_comp,
                         std::vector<Specialization>{{1, mode}, tiled});
  return steps;
}

/// Cells for fields that only split methods need.
std::size_t split_cells(const FluidProblem& problem) {
  return is_split(problem.parameters.method) ? problem.domain.cell_count() : 0;
}

std::array<Buffer<float>, 2> make_pair_of(Context& context, std::size_t cells) {
  return {Buffer<float>(context, cells), Buffer<float>(context, cells)};
}

std::size_t spin_cells(const FluidProblem& problem) {
  return problem.parameters.vorticity_confinement > 0 ? split_cells(problem) : 0;
}

}  // namespace

FluidSimulation::FluidSimulation(Context& context, const FluidProblem& problem)
    : context_(context),
      problem_(problem),
      memory_before_(context.memory_bytes()),
      buffers_(context, problem),
      projection_(context, buffers_, problem),
      smoke_(context, split_cells(problem)),
      temperature_(context, split_cells(problem)),
      forth_(make_pair_of(context, split_cells(problem))),
      carried_(make_pair_of(context, split_cells(problem))),
      partials_(context, 3 * speed_chunks),
      vorticity_(context, spin_cells(problem)),
      spin_(context, spin_cells(problem)),
      clock_(context, shaders::fluid_clock_comp),
      speed_(context, shaders::fluid_speed_comp, {buffers_.tiled()}),
      rate_(context, shaders::fluid_rate_comp),
      advect_(context, shaders::fluid_advect_comp, {buffers_.tiled()}),
      diffuse_(context, shaders::fluid_diffuse_comp, {buffers_.tiled()}),
      carry_smoke_(context, shaders::fluid_carry_smoke_comp, {buffers_.tiled()}),
      solid_faces_(context, shaders::fluid_solid_faces_comp, {buffers_.tiled()}),
      cell_types_(context, shaders::fluid_cell_types_comp, {buffers_.tiled()}),
      smoke_steps_(make_smoke_steps(context, problem.parameters.method, buffers_.tiled())) {
  if (buffers_.tiles) active_tiles_ = std::make_unique<ActiveTiles>(context, buffers_, problem_);
  if (is_liquid(problem.parameters.method))
    liquid_ = std::make_unique<Liquid>(context, buffers_, problem_);
  write(problem.initial);
  memory_bytes_ = context.memory_bytes() - memory_before_;
}

FluidSimulation::~FluidSimulation() = default;

FluidArgs FluidSimulation::args() const {
  return {.scene = buffers_.scene,
          .clock = buffers_.clock,
          .velocity = buffers_.velocity,
          .other = buffers_.other,
          .result = buffers_.third,
          .field = partials_,
          .field_result = partials_,
          .axis = 0,
          .mode = 0,
          .weight = 0};
}

void FluidSimulation::set_end(double time) {
  FluidClock now = clock();
  now.end = float(time);
  write_clock(now);
}

void FluidSimulation::write_clock(const FluidClock& clock) {
  buffers_.clock.write(std::vector<FluidClock>{clock});
}

void FluidSimulation::visit_all_tiles() {
  if (!buffers_.tiles) return;
  buffers_.tiles->visit_all();
  buffers_.tiles->activate_all(context_);
}

FluidClock FluidSimulation::clock() const { return buffers_.clock.read().front(); }

void FluidSimulation::write(const FluidState& state) {
  problem_.initial = state;
  check_fluid_problem(problem_);
  buffers_.velocity.write(state.velocity);
  buffers_.other.write(state.velocity);
  buffers_.third.write(state.velocity);
  projection_.write_pressure(state.pressure);
  buffers_.clock.write(std::vector<FluidClock>{{.step = 0,
                                                .time = float(state.time),
                                                .end = std::numeric_limits<float>::max(),
                                                .speed = 0,
                                                .steps = state.steps,
                                                .unconverged = 0}});
  if (is_split(problem_.parameters.method)) {
    smoke_.write(floats_of(state.smoke));
    temperature_.write(floats_of(state.temperature));
    forth_[0].write(floats_of(state.smoke));
    forth_[1].write(floats_of(state.temperature));
  }
  if (liquid_) liquid_->write(state.particles);
  if (buffers_.tiles) buffers_.tiles->activate_all(context_);
  if (buffers_.with_solids) context_.run([&](Commands& commands) { record_solids(commands); });
}

FluidState FluidSimulation::read() const {
  FluidState state = resting_state(problem_.domain);
  const FluidClock now = clock();
  state.time = double(now.time);
  state.steps = now.steps;
  state.velocity = buffers_.velocity.read(buffers_.cells);
  state.pressure = projection_.read_pressure();
  if (is_split(problem_.parameters.method)) {
    state.smoke = field_of(buffers_.cells, smoke_.read());
    state.temperature = field_of(buffers_.cells, temperature_.read());
  } else {
    state.smoke = problem_.initial.smoke;
    state.temperature = problem_.initial.temperature;
  }
  if (liquid_) state.particles = liquid_->read();
  if (active_tiles_) state.active = active_tiles_->read_active();
  return state;
}

FluidClock FluidSimulation::run_until(double time, std::uint32_t batch, std::uint32_t max_steps) {
  set_end(time);
  const std::uint32_t first = clock().steps;
  for (;;) {
    context_.run([&](Commands& commands) {
      for (std::uint32_t k = 0; k < batch; ++k) record_step(commands);
    });
    const FluidClock now = clock();
    if (now.step == 0 || now.steps - first >= max_steps) return now;
  }
}

FluidState FluidSimulation::run_part(Part part, float seconds) {
  FluidClock now = clock();
  now.step = seconds;
  buffers_.clock.write(std::vector<FluidClock>{now});
  context_.run([&](Commands& commands) {
    if (part == Part::advection) {
      record_carry_smoke(commands);
      commands.copy(carried_[0], smoke_, 0, 0, smoke_.count());
      commands.copy(carried_[1], temperature_, 0, 0, smoke_.count());
      record_advection(commands);
    } else if (part == Part::viscosity) {
      record_viscosity(commands);
    } else {
      projection_.record(commands, buffers_.other, 1);
    }
  });
  FluidState state = read();
  state.velocity = buffers_.other.read(buffers_.cells);
  return state;
}

void FluidSimulation::record_step(Commands& commands) {
  record_choice(commands);
  record_given_step(commands);
}

void FluidSimulation::record_given_step(Commands& commands) {
  if (liquid_) liquid_->record_sort(commands);
  if (active_tiles_) record_tiles(commands);
  if (std::ranges::any_of(problem_.solids,
                          [](const FluidSolid& solid) { return solid.velocity != dvec3(0); }))
    record_solids(commands);
  if (liquid_) {
    liquid_->record_to_grid(commands);
    record_cells(commands);
    liquid_->record_forces(commands);
    projection_.record(commands, buffers_.velocity, 1);
    liquid_->record_to_particles(commands);
  } else if (is_split(problem_.parameters.method)) {
    record_split(commands);
  } else {
    record_runge_kutta(commands);
  }
  record_clock(commands, 1);
}

void FluidSimulation::record_clock(Commands& commands, std::uint32_t mode) {
  FluidArgs now = args();
  if (mode == 0) {
    std::uint32_t first = 0;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const std::uint32_t faces = buffers_.threads(int(axis)).x;
      const std::uint32_t run = buffers_.tiles ? 0 : speed_run(faces);
      const std::uint32_t chunks = run == 0 ? tile_speeds : (faces + run - 1) / run;
      now.axis = axis;
      now.mode = first;
      now.weight = float(run);
      commands.dispatch(speed_, {chunks}, now);
      first += chunks;
    }
  }
  now.mode = mode;
  commands.dispatch(clock_, {1}, now);
}

void FluidSimulation::record_tiles(Commands& commands) {
  const BufferRef<std::uint32_t> ranges =
      liquid_ ? liquid_->ranges().ref() : BufferRef<std::uint32_t>{};
  active_tiles_->record_choice(commands, smoke_, temperature_, ranges);
  active_tiles_->record_clear_faces(commands);
  active_tiles_->record_clear(commands, {projection_.system().pressure().ref().address}, 0);
  if (liquid_) return;
  for (const Buffer<float>* field : {&smoke_, &temperature_, &forth_[0], &forth_[1]})
    active_tiles_->record_clear(commands, *field, 1);
  if (problem_.parameters.vorticity_confinement > 0)
    for (const Buffer<vec4>* field : {&vorticity_, &spin_})
      active_tiles_->record_clear(commands, {field->ref().address}, 4);
  record_cells(commands);
}

void FluidSimulation::record_solids(Commands& commands) {
  FluidCellArgs now{.scene = buffers_.scene,
                    .clock = buffers_.clock,
                    .open = buffers_.open,
                    .boundary = buffers_.boundary,
                    .types = buffers_.types,
                    .ranges = {},
                    .axis = 0,
                    .is_liquid = 0};
  for (now.axis = 0; now.axis < 3; ++now.axis)
    buffers_.dispatch(commands, solid_faces_, now.axis, now);
  if (!liquid_) record_cells(commands);
}

void FluidSimulation::record_cells(Commands& commands) {
  const FluidCellArgs now{.scene = buffers_.scene,
                          .clock = buffers_.clock,
                          .open = buffers_.open,
                          .boundary = buffers_.boundary,
                          .types = buffers_.types,
                          .ranges = liquid_ ? liquid_->ranges().ref() : BufferRef<std::uint32_t>{},
                          .axis = 0,
                          .is_liquid = liquid_ ? 1u : 0u};
  if (buffers_.tiles) {
    buffers_.tiles->dispatch(commands, cell_types_, touched_cells, now);
  } else {
    commands.dispatch(cell_types_, buffers_.threads(3), now);
  }
  projection_.record_cells(commands);
}

void FluidSimulation::record_rate(Commands& commands, const FluidFaces& from, const FluidFaces& to,
                                  float weight) {
  FluidArgs now = args();
  now.other = buffers_.velocity;
  now.velocity = from;
  now.result = to;
  now.weight = weight;
  for (now.axis = 0; now.axis < axes(); ++now.axis)
    commands.dispatch(rate_, buffers_.threads(int(now.axis)), now);
  projection_.record(commands, to, 1 - weight);
}

void FluidSimulation::record_runge_kutta(Commands& commands) {
  record_rate(commands, buffers_.velocity, buffers_.other, 0);
  record_rate(commands, buffers_.other, buffers_.third, 0.75f);
  record_rate(commands, buffers_.third, buffers_.velocity, 1.0f / 3);
}

void FluidSimulation::record_carry_smoke(Commands& commands) {
  const bool is_corrected = problem_.parameters.method == FluidMethod::maccormack;
  const std::array<Buffer<float>, 2>& first = is_corrected ? forth_ : carried_;
  FluidCarryArgs now{.scene = buffers_.scene,
                     .clock = buffers_.clock,
                     .velocity = buffers_.velocity,
                     .smoke = smoke_,
                     .temperature = temperature_,
                     .smoke_forth = first[0],
                     .temperature_forth = first[1],
                     .carried_smoke = carried_[0],
                     .carried_temperature = carried_[1],
                     .mode = 0,
                     .padding = 0};
  buffers_.dispatch(commands, carry_smoke_, 3, now);
  if (!is_corrected) return;
  now.mode = 1;
  buffers_.dispatch(commands, carry_smoke_, 3, now);
}

void FluidSimulation::record_smoke(Commands& commands, std::uint32_t mode, std::uint32_t axis) {
  const FluidScalarArgs now{.scene = buffers_.scene,
                            .clock = buffers_.clock,
                            .velocity = buffers_.other,
                            .pushed = buffers_.velocity,
                            .carried_smoke = carried_[0],
                            .carried_temperature = carried_[1],
                            .smoke = smoke_,
                            .temperature = temperature_,
                            .vorticity = vorticity_,
                            .spin = spin_,
                            .axis = axis,
                            .mode = mode};
  buffers_.dispatch(commands, smoke_steps_[mode], mode == std::uint32_t(Smoke::forces) ? axis : 3,
                    now);
}

/// velocity to other; third is scratch.
void FluidSimulation::record_advection(Commands& commands) {
  FluidArgs now = args();
  const bool is_corrected = problem_.parameters.method == FluidMethod::maccormack;
  now.result = is_corrected ? buffers_.third : buffers_.other;
  for (now.axis = 0; now.axis < axes(); ++now.axis)
    buffers_.dispatch(commands, advect_, now.axis, now);
  if (!is_corrected) return;
  now.other = buffers_.third;
  now.result = buffers_.other;
  now.mode = 1;
  for (now.axis = 0; now.axis < axes(); ++now.axis)
    buffers_.dispatch(commands, advect_, now.axis, now);
}

void FluidSimulation::record_copy(Commands& commands, const FaceBuffers& from,
                                  const FaceBuffers& to) {
  FluidArgs now = args();
  now.velocity = from;
  now.result = to;
  now.mode = 2;
  for (int axis = 0; axis < int(axes()); ++axis) {
    now.axis = std::uint32_t(axis);
    if (buffers_.tiles) {
      buffers_.dispatch(commands, advect_, now.axis, now);
    } else {
      commands.copy(from[axis], to[axis], 0, 0, from[axis].count());
    }
  }
}

void FluidSimulation::record_viscosity(Commands& commands) {
  FluidArgs now = args();
  record_copy(commands, buffers_.other, buffers_.third);
  now.velocity = buffers_.third;
  now.result = buffers_.other;
  if (!problem_.parameters.implicit_viscosity) {
    now.mode = 2;
    for (now.axis = 0; now.axis < axes(); ++now.axis)
      buffers_.dispatch(commands, diffuse_, now.axis, now);
    return;
  }
  now.velocity = buffers_.other;
  now.other = buffers_.third;
  for (int sweep = 0; sweep < implicit_sweeps; ++sweep)
    for (now.mode = 0; now.mode < 2; ++now.mode)
      for (now.axis = 0; now.axis < axes(); ++now.axis)
        buffers_.dispatch(commands, diffuse_, now.axis, now);
}

void FluidSimulation::record_split(Commands& commands) {
  record_carry_smoke(commands);
  record_advection(commands);
  // Before the forces: what they push against a wall is not yet flow that could rub on it.
  if (problem_.parameters.viscosity > 0) record_viscosity(commands);
  record_smoke(commands, std::uint32_t(Smoke::sources), 0);
  if (problem_.parameters.vorticity_confinement > 0) {
    record_smoke(commands, std::uint32_t(Smoke::vorticity), 0);
    record_smoke(commands, std::uint32_t(Smoke::spin), 0);
  }
  for (std::uint32_t axis = 0; axis < axes(); ++axis)
    record_smoke(commands, std::uint32_t(Smoke::forces), axis);
  projection_.record(commands, buffers_.velocity, 1);
}

FluidState step(Context& context, const FluidProblem& problem, const FluidState& state,
                double seconds) {
  FluidProblem now = problem;
  now.initial = state;
  now.parameters.fixed_step = seconds;
  FluidSimulation simulation(context, now);
  context.run([&](Commands& commands) { simulation.record_step(commands); });
  return simulation.read();
}

namespace {

FluidState run_part(Context& context, const FluidProblem& problem, const FluidState& state,
                    FluidSimulation::Part part, double seconds) {
  FluidProblem now = problem;
  now.initial = state;
  FluidSimulation simulation(context, now);
  return simulation.run_part(part, float(seconds));
}

}  // namespace

FluidState advect(Context& context, const FluidProblem& problem, const FluidState& state,
                  double seconds) {
  return run_part(context, problem, state, FluidSimulation::Part::advection, seconds);
}

FluidState diffuse(Context& context, const FluidProblem& problem, const FluidState& state,
                   double seconds) {
  return run_part(context, problem, state, FluidSimulation::Part::viscosity, seconds);
}

FluidState project(Context& context, const FluidProblem& problem, const FluidState& state,
                   double seconds) {
  return run_part(context, problem, state, FluidSimulation::Part::projection, seconds);
}

}  // namespace parity::gpu
