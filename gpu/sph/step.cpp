#include "gpu/sph/step.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "gpu/core/error.h"
#include "gpu/sph/constants.h"
#include "shaders.h"

namespace parity::gpu {
namespace {

constexpr std::uint32_t block = 256;
constexpr std::uint32_t steps_a_submission = 16;

/// A double as the sum of two floats, exact to 2^-48.
struct Split {
  float high;
  float rest;
};
Split split(double value) {
  const auto high = float(value);
  return {high, float(value - double(high))};
}

}  // namespace

SphStep::SphStep(Context& context, const SphProblem& problem)
    : count_(std::uint32_t(problem.initial.positions.size())),
      blocks_((count_ + block - 1) / block),
      neighbours_(context, problem, sph_constants(problem)),
      densities_(context, sph_constants(problem)),
      forces_(context, problem, sph_constants(problem)),
      limits_(context, shaders::sph_limits_comp),
      clock_(context, shaders::sph_clock_comp),
      integrate_(context, shaders::sph_integrate_comp),
      solve_end_(context, shaders::sph_solve_end_comp),
      positions_(context, count_),
      velocities_(context, count_),
      densities_of_ids_(context, std::vector<float>(count_)),
      pressures_(context, count_),
      block_limits_(context, blocks_),
      clock_buffer_(context, std::vector<SphClock>(1)) {
  if (problem.parameters.method != SphMethod::weakly_compressible)
    solver_.emplace(context, problem, sph_constants(problem));
  if (problem.parameters.implicit_viscosity && problem.parameters.viscosity > 0)
    viscosity_.emplace(context, problem, sph_constants(problem));
  write(problem.initial);
}

void SphStep::write(const SphState& state) {
  if (state.positions.size() != count_ || state.velocities.size() != count_)
    throw std::invalid_argument("SphStep::write: " + std::to_string(state.positions.size()) +
                                " positions and " + std::to_string(state.velocities.size()) +
                                " velocities, must be " + std::to_string(count_));
  positions_.write(with_zero(state.positions));
  velocities_.write(with_zero(state.velocities));
  if (!state.pressures.empty() && state.pressures.size() != count_)
    throw std::invalid_argument("SphStep::write: " + std::to_string(state.pressures.size()) +
                                " pressures, must be 0 or " + std::to_string(count_));
  pressures_.write(state.pressures.empty() ? std::vector<float>(count_) : state.pressures);
  SphClock clock{};
  clock.time = split(state.time).high;
  clock.time_rest = split(state.time).rest;
  clock_buffer_.write(std::vector<SphClock>{clock});
}

SphState SphStep::read() const {
  SphState state;
  state.time = report().time;
  for (const vec4& p : positions_.read()) state.positions.emplace_back(p);
  for (const vec4& v : velocities_.read()) state.velocities.emplace_back(v);
  state.pressures = pressures_.read();
  return state;
}

SphReport SphStep::report() const {
  const SphClock clock = clock_buffer_.read()[0];
  const SphSolver solver = solver_ ? solver_->solver().read()[0] : SphSolver{};
  return {.time = double(clock.time) + double(clock.time_rest),
          .last_step = clock.step,
          .max_speed = clock.max_speed,
          .max_density = clock.max_density,
          .steps = clock.steps,
          .iterations = solver.iterations,
          .compression = solver.average,
          .divergence_iterations = solver_ ? solver_->divergence_solver().read()[0].iterations : 0,
          .viscous_iterations = viscosity_ ? viscosity_->solver().read()[0].iterations : 0,
          .crowded = clock.crowded};
}

void SphStep::record_clock(Commands& commands, double until) {
  if (count_ > 0)
    commands.dispatch(limits_, {blocks_},
                      {.constants = neighbours_.constants(),
                       .places = densities_.places(),
                       .motions = densities_.motions(),
                       .accelerations = forces_.accelerations(),
                       .counts = neighbours_.counts(),
                       .limits = block_limits_,
                       .count = count_,
                       .block = block});
  commands.dispatch(clock_, {1},
                    {.constants = neighbours_.constants(),
                     .limits = block_limits_,
                     .clock = clock_buffer_,
                     .until = split(until).high,
                     .until_rest = split(until).rest,
                     .blocks = blocks_});
}

void SphStep::record(Commands& commands, double until) {
  neighbours_.record(commands, positions_);
  commands.pass("density");
  densities_.record(commands, neighbours_, velocities_);
  commands.pass("forces");
  forces_.record(commands, neighbours_, densities_);
  commands.pass("step");
  record_clock(commands, until);
  if (viscosity_) {
    commands.pass("viscosity");
    viscosity_->record(commands, neighbours_, densities_, forces_.accelerations(), clock_buffer_);
  }
  if (count_ > 0) record_motion(commands);
}

void SphStep::record_motion(Commands& commands) {
  if (!solver_) {
    commands.dispatch(integrate_, {count_},
                      {.constants = neighbours_.constants(),
                       .clock = clock_buffer_,
                       .ids = neighbours_.cells().ids(),
                       .places = densities_.places(),
                       .motions = densities_.motions(),
                       .accelerations = forces_.accelerations(),
                       .positions = positions_,
                       .velocities = velocities_,
                       .densities = densities_of_ids_,
                       .pressures = pressures_,
                       .count = count_});
    return;
  }
  commands.pass("pressure");
  solver_->record(commands, neighbours_, densities_, forces_, clock_buffer_, pressures_);
  commands.dispatch(solve_end_, {count_},
                    {.clock = clock_buffer_,
                     .ids = neighbours_.cells().ids(),
                     .places = densities_.places(),
                     .moved = solver_->moved(),
                     .impulses = solver_->impulses(),
                     .positions = positions_,
                     .velocities = velocities_,
                     .densities = densities_of_ids_,
                     .pressures = pressures_,
                     .count = count_});
}

SphReport advance(Context& context, SphStep& step, double until, std::uint32_t max_steps) {
  std::uint32_t left = max_steps;
  while (left > 0) {
    const std::uint32_t now = std::min(left, steps_a_submission);
    context.run([&](Commands& commands) {
      for (std::uint32_t k = 0; k < now; ++k) step.record(commands, until);
    });
    left -= now;
    const SphReport report = step.report();
    if (report.crowded > 0)
      throw Error(ErrorKind::other, "SphStep: " + std::to_string(report.crowded) +
                                        " particles lost neighbours by " +
                                        std::to_string(report.time) + " s: the run is unstable");
    if (report.time >= double(split(until).high) + double(split(until).rest)) return report;
  }
  throw Error(ErrorKind::other, "SphStep: " + std::to_string(max_steps) + " steps end at " +
                                    std::to_string(step.report().time) + " s, before " +
                                    std::to_string(until) + " s");
}

SphResult sph_step(Context& context, const SphProblem& problem, double until,
                   std::uint32_t max_steps) {
  SphStep step(context, problem);
  const SphReport report = advance(context, step, until, max_steps);
  return {step.read(), step.densities().read(), report};
}

}  // namespace parity::gpu
