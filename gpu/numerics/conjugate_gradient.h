#pragma once

#include <memory>

#include "gpu/numerics/multigrid.h"
#include "gpu/numerics/pressure_system.h"

namespace parity::gpu {

enum class Preconditioner : std::uint32_t { none, multigrid };

/// Conjugate gradients, plain or preconditioned by one multigrid cycle. All on the device: scalars
/// pass from kernel to kernel, sums have one order, what follows convergence is skipped.
///
/// Source: notes 9.3; Hestenes & Stiefel 1952; McAdams, Sifakis & Teran 2010. beta is that of Polak
/// & Ribiere, because the cycle is only nearly symmetric.
class ConjugateGradient {
 public:
  ConjugateGradient(Context& context, PressureSystem& system, Preconditioner preconditioner);

  /// At most `iterations` steps from the pressure that is there to the control's tolerance. The
  /// system's right side becomes the residual.
  ///
  /// @param remove_mean  takes its mean off the right side first, where no side is open and moving
  ///                     solids may leave one; needs words.
  void record_solve(Commands& commands, std::uint32_t iterations, bool remove_mean = false);
  /// What the pressure is too coarse to hold: the solution is the sum of both.
  const Buffer<PressureQuad>& pressure_low() const { return solution_low_; }
  /// More steps of the same solve.
  void record_more(Commands& commands, std::uint32_t iterations);

 private:
  void record_vectors(Commands& commands, const Kernel<VectorArgs>& kernel);
  std::uint32_t vector_threads() const;

  PressureSystem& system_;
  std::unique_ptr<Multigrid> multigrid_;
  Kernel<SweepArgs> residual_, apply_;
  Kernel<VectorArgs> dots_, direction_, advance_, sums_, subtract_mean_;
  Buffer<PressureQuad> solution_, solution_low_, direction_vector_, image_;
};

/// @param problem  as in sim/pressure.h.
///
/// Mathematics: cpu::conjugate_gradient. The solution is kept in two floats: relative residuals
/// down to 1e-6 can be asked for, whatever the size of the pressure.
PressureAnswer conjugate_gradient(Context& context, const PressureProblem& problem,
                                  Preconditioner preconditioner);

}  // namespace parity::gpu
