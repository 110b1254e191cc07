#pragma once

#include <array>
#include <memory>

#include "gpu/fluid/fluid_buffers.h"
#include "gpu/fluid/project.h"
#include "gpu/fluid/tiles.h"

namespace parity::gpu {

class Liquid;

/// A fluid that lives on the device. Steps are recorded without reading anything back: the step is
/// chosen there, what follows convergence or the end is skipped there.
///
/// Mathematics: cpu::step. Kernels are those of the stages fluid/advect, fluid/diffuse,
/// fluid/project, numerics/pressure.
class FluidSimulation {
 public:
  /// @throws std::invalid_argument  as check_fluid_problem.
  FluidSimulation(Context& context, const FluidProblem& problem);
  ~FluidSimulation();

  /// One step, at most to the time of set_end.
  void record_step(Commands& commands);
  /// The two halves of record_step: the clock's choice of a step, and a step that is in the clock.
  void record_choice(Commands& commands) { record_clock(commands, 0); }
  void record_given_step(Commands& commands);
  void write_clock(const FluidClock& clock);
  /// Time that steps do not pass; call between runs.
  void set_end(double time);

  /// Steps until `time`, `batch` a submission; stops early after `max_steps`.
  ///
  /// @return  the clock: time reached, steps so far, projections that kept too much divergence.
  FluidClock run_until(double time, std::uint32_t batch = 8, std::uint32_t max_steps = 1000000);

  /// Only one part of a step of `seconds`, then the state.
  enum class Part { advection, viscosity, projection };
  FluidState run_part(Part part, float seconds);

  /// A sparse fluid's kernels visit the whole box from now on and turn away from what is not
  /// active: the same bits at the cost of the box.
  void visit_all_tiles();

  FluidClock clock() const;
  FluidState read() const;
  /// Goes on from another state of the same domain, e.g. a checkpoint: the same state gives the
  /// same bits.
  void write(const FluidState& state);

  const FluidBuffers& buffers() const { return buffers_; }
  const Buffer<float>& smoke() const { return smoke_; }
  const Buffer<float>& temperature() const { return temperature_; }
  const Buffer<PressureQuad>& pressure() const { return projection_.system().pressure(); }
  /// Bytes on the device.
  std::uint64_t memory_bytes() const { return memory_bytes_; }

 private:
  void record_clock(Commands& commands, std::uint32_t mode);
  void record_tiles(Commands& commands);
  void record_solids(Commands& commands);
  void record_cells(Commands& commands);
  void record_rate(Commands& commands, const FluidFaces& from, const FluidFaces& to, float weight);
  void record_runge_kutta(Commands& commands);
  void record_split(Commands& commands);
  void record_carry_smoke(Commands& commands);
  void record_advection(Commands& commands);
  void record_smoke(Commands& commands, std::uint32_t mode, std::uint32_t axis);
  void record_copy(Commands& commands, const FaceBuffers& from, const FaceBuffers& to);
  void record_viscosity(Commands& commands);
  FluidArgs args() const;
  /// Axes with more than one cell.
  std::uint32_t axes() const { return buffers_.cells.z > 1 ? 3 : 2; }

  Context& context_;
  FluidProblem problem_;
  std::uint64_t memory_before_;
  FluidBuffers buffers_;
  Projection projection_;
  Buffer<float> smoke_, temperature_;
  std::array<Buffer<float>, 2> forth_, carried_;  ///< of smoke and temperature
  Buffer<float> partials_;
  Buffer<vec4> vorticity_, spin_;
  Kernel<FluidArgs> clock_, speed_, rate_, advect_, diffuse_;
  Kernel<FluidCarryArgs> carry_smoke_;
  Kernel<FluidCellArgs> solid_faces_, cell_types_;
  std::vector<Kernel<FluidScalarArgs>> smoke_steps_;
  std::unique_ptr<Liquid> liquid_;
  std::unique_ptr<ActiveTiles> active_tiles_;
  std::uint64_t memory_bytes_ = 0;
};

/// Velocity, smoke and temperature of a split method carried along for `seconds`.
///
/// Mathematics: cpu::advect.
FluidState advect(Context& context, const FluidProblem& problem, const FluidState& state,
                  double seconds);

/// Viscosity alone. Implicit: 64 red-black sweeps, for steps up to ten explicit ones.
///
/// Mathematics: cpu::diffuse_explicit, cpu::diffuse_implicit.
FluidState diffuse(Context& context, const FluidProblem& problem, const FluidState& state,
                   double seconds);

/// One step of `seconds` from a state.
FluidState step(Context& context, const FluidProblem& problem, const FluidState& state,
                double seconds);

}  // namespace parity::gpu
