#pragma once

#include "gpu/fluid/step.h"
#include "sim/step_control.h"

namespace parity::gpu {

/// Steps a simulation by the error of its steps: each is made once whole and then in two halves,
/// which stay. What a step begins from is kept on the device, so a refused one leaves no trace.
/// Memory: as much again as velocity (twice), pressure, smoke and temperature.
///
/// Mathematics: cpu::adaptive_step.
class AdaptiveFluid {
 public:
  /// @param simulation  outlives this; its parameters.step_error is the tolerance.
  AdaptiveFluid(Context& context, FluidSimulation& simulation, const FluidParameters& parameters);

  /// One step, at most to `until`.
  ///
  /// @return  1; 0 if the clock, a float, cannot tell the times apart.
  std::uint32_t step(StepControl& control, double until);

  /// Makes a step of `seconds` in two halves; its error. `undo` takes back the last one.
  double try_step(float seconds);
  void undo();

 private:
  float stable_step();
  void record_copies(Commands& commands, bool back);
  void record_largest(Commands& commands, const Kernel<FluidArgs>& kernel,
                      const FluidFaces& velocity);
  float read_largest() const;

  Context& context_;
  FluidSimulation& simulation_;
  FluidParameters parameters_;
  FaceBuffers velocity_, whole_;
  Buffer<PressureQuad> pressure_;
  Buffer<float> smoke_, temperature_;
  FluidClock clock_{};
  Buffer<float> partials_;
  Kernel<FluidArgs> speed_, difference_;
};

}  // namespace parity::gpu
