#pragma once

#include "gpu/numerics/pressure_system.h"

namespace parity::gpu {

enum class RelaxationMethod : std::uint32_t { jacobi, gauss_seidel, sor };

/// Sweeps over the finest grid: Jacobi, red-black Gauss-Seidel, or the latter over-relaxed.
///
/// Source: notes 9.3; row 148.
class Relaxation {
 public:
  Relaxation(Context& context, PressureSystem& system, RelaxationMethod method);

  /// @param omega  damping of Jacobi (1: none), or over-relaxation; Gauss-Seidel takes 1.
  void record_sweeps(Commands& commands, std::uint32_t count, float omega);
  /// Residual and done in the control.
  void record_measure(Commands& commands);

 private:
  PressureSystem& system_;
  RelaxationMethod method_;
  Kernel<SweepArgs> sweep_, measure_;
  Buffer<PressureQuad> other_;  ///< Jacobi's second array
};

/// Sweeps to the tolerance, looked at every 16 sweeps; Jacobi takes an even number.
///
/// Mathematics: cpu::relaxation.
PressureAnswer relaxation(Context& context, const PressureProblem& problem, RelaxationMethod method,
                          double omega);

}  // namespace parity::gpu
