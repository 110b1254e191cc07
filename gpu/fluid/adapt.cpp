#include "gpu/fluid/adapt.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shaders.h"

namespace parity::gpu {
namespace {

constexpr std::uint32_t chunks_of_axis = 256;

void record_faces(Commands& commands, const FaceBuffers& from, const FaceBuffers& to) {
  for (int axis = 0; axis < 3; ++axis)
    commands.copy(from[axis], to[axis], 0, 0, from[axis].count());
}

}  // namespace

AdaptiveFluid::AdaptiveFluid(Context& context, FluidSimulation& simulation,
                             const FluidParameters& parameters)
    : context_(context),
      simulation_(simulation),
      parameters_(parameters),
      velocity_(context, simulation.buffers().cells),
      whole_(context, simulation.buffers().cells),
      pressure_(context, simulation.pressure().count()),
      smoke_(context, simulation.smoke().count()),
      temperature_(context, simulation.temperature().count()),
      partials_(context, 3 * chunks_of_axis),
      speed_(context, shaders::fluid_speed_comp),
      difference_(context, shaders::fluid_speed_comp, {{3, 1}}) {}

/// The clock's own choice, with no end in sight.
float AdaptiveFluid::stable_step() {
  clock_ = simulation_.clock();
  FluidClock endless = clock_;
  endless.end = std::numeric_limits<float>::max();
  endless.time = 0;
  simulation_.write_clock(endless);
  context_.run([&](Commands& commands) { simulation_.record_choice(commands); });
  const float step = simulation_.clock().step;
  simulation_.write_clock(clock_);
  return step;
}

void AdaptiveFluid::record_copies(Commands& commands, bool back) {
  const auto copy = [&](const auto& ours, const auto& theirs) {
    if (ours.count() == 0) return;
    commands.copy(back ? ours : theirs, back ? theirs : ours, 0, 0, ours.count());
  };
  for (int axis = 0; axis < 3; ++axis) copy(velocity_[axis], simulation_.buffers().velocity[axis]);
  copy(pressure_, simulation_.pressure());
  copy(smoke_, simulation_.smoke());
  copy(temperature_, simulation_.temperature());
}

void AdaptiveFluid::record_largest(Commands& commands, const Kernel<FluidArgs>& kernel,
                                   const FluidFaces& velocity) {
  const FluidBuffers& buffers = simulation_.buffers();
  FluidArgs args{.scene = buffers.scene,
                 .clock = buffers.clock,
                 .velocity = velocity,
                 .other = whole_,
                 .result = {},
                 .field = partials_,
                 .field_result = {},
                 .axis = 0,
                 .mode = 0,
                 .weight = 0};
  commands.fill(partials_, 0);
  for (; args.axis < 3; ++args.axis, args.mode += chunks_of_axis) {
    const std::uint32_t faces = buffers.threads(int(args.axis)).x;
    const std::uint32_t run = (faces + chunks_of_axis - 1) / chunks_of_axis;
    args.weight = float(run);
    commands.dispatch(kernel, {(faces + run - 1) / run}, args);
  }
}

float AdaptiveFluid::read_largest() const {
  float largest = 0;
  for (const float value : partials_.read()) largest = std::fmax(largest, value);
  return largest;
}

double AdaptiveFluid::try_step(float seconds) {
  clock_ = simulation_.clock();
  FluidClock now = clock_;
  now.step = seconds;
  simulation_.write_clock(now);
  context_.run([&](Commands& commands) {
    record_copies(commands, false);
    simulation_.record_given_step(commands);
    record_faces(commands, simulation_.buffers().velocity, whole_);
    record_copies(commands, true);
  });
  now.step = 0.5f * seconds;
  simulation_.write_clock(now);
  context_.run([&](Commands& commands) {
    simulation_.record_given_step(commands);
    simulation_.record_given_step(commands);
    record_largest(commands, speed_, simulation_.buffers().velocity);
  });
  const float speed = read_largest();
  context_.run([&](Commands& commands) {
    record_largest(commands, difference_, simulation_.buffers().velocity);
  });
  FluidClock after = simulation_.clock();
  after.time = clock_.time + seconds;
  after.steps = clock_.steps + 1;
  simulation_.write_clock(after);
  return step_error(double(read_largest()), double(speed), order_of(parameters_.method));
}

void AdaptiveFluid::undo() {
  simulation_.write_clock(clock_);
  context_.run([&](Commands& commands) { record_copies(commands, true); });
}

std::uint32_t AdaptiveFluid::step(StepControl& control, double until) {
  const double stable = double(stable_step());
  const float begin = clock_.time, left = float(until) - begin;
  for (;;) {
    const float seconds = float(trial_step(control, stable, double(left)));
    const double error = try_step(seconds);
    if (settle_step(control, error, parameters_.step_error, double(seconds), stable,
                    order_of(parameters_.method))) {
      FluidClock after = simulation_.clock();
      if (seconds == left) after.time = float(until);
      simulation_.write_clock(after);
      return after.time > begin ? 1 : 0;
    }
    undo();
  }
}

}  // namespace parity::gpu
