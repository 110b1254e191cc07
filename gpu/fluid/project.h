#pragma once

#include <memory>

#include "gpu/fluid/fluid_buffers.h"
#include "gpu/numerics/conjugate_gradient.h"
#include "gpu/numerics/multigrid.h"

namespace parity::gpu {

/// Takes the divergence out of a velocity field: right side, pressure, gradient. The pressure of
/// the last call is the guess of the next. A box of fluid is solved by multigrid alone, one with
/// solids or air by conjugate gradients that multigrid preconditions.
///
/// Mathematics: cpu::project.
class Projection {
 public:
  Projection(Context& context, FluidBuffers& buffers, const FluidProblem& problem);

  /// Packs types and open fractions for the solver; where solids move or liquid flows, each step.
  void record_cells(Commands& commands);
  /// Projects `velocity` in place over a part of the clock's step.
  void record(Commands& commands, const FluidFaces& velocity, float part);

  const PressureSystem& system() const { return system_; }
  void write_pressure(const Field& pressure);
  Field read_pressure() const { return system_.to_field(system_.pressure().read()); }

 private:
  FluidProjectArgs args(const FluidFaces& velocity) const;

  FluidBuffers& buffers_;
  PressureSystem system_;
  std::unique_ptr<Multigrid> multigrid_;
  std::unique_ptr<ConjugateGradient> conjugate_gradient_;
  Kernel<FluidProjectArgs> divergence_, subtract_, start_;
  bool keep_tiles_;  ///< solids are at rest and nothing else changes a tile
  std::uint32_t iterations_;
  bool remove_mean_;
};

/// Projects the velocity of a state over one step of `seconds`; velocity and pressure change.
FluidState project(Context& context, const FluidProblem& problem, const FluidState& state,
                   double seconds);

}  // namespace parity::gpu
