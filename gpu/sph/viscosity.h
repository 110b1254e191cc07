#pragma once

#include "gpu/sph/forces.h"

namespace parity::gpu {

/// Velocities that an implicit step of viscosity leads to, by conjugate gradients without a matrix.
///
/// Converges: the matrix is symmetric with eigenvalues >= 1, so the residual bounds the error; the
/// error falls at least by (sqrt(k) - 1) / (sqrt(k) + 1) an iteration, k <= 1 + 2 dt times the rate
/// of an explicit step.
/// Stable for any step and viscosity.
/// Source: Weiler, Koschier, Brand & Bender 2018; Chronopoulos & Gear 1989 (one sum an iteration).
/// Differs from the paper: no preconditioner, so that momentum is kept to rounding; mean densities,
/// which make the matrix symmetric.
class ViscositySolver {
 public:
  ViscositySolver(Context& context, const SphProblem& problem, const SphConstants& constants);

  /// Adds to the accelerations what makes velocities after the step of the clock those of an
  /// implicit step.
  void record(Commands& commands, const Neighbours& neighbours, const Densities& densities,
              BufferRef<vec4> accelerations, BufferRef<SphClock> clock);

  const Buffer<SphViscous>& solver() const { return solver_; }
  /// Sorted.
  const Buffer<vec4>& solution() const { return solution_; }

 private:
  void record_iterations(Commands& commands, ViscousApplyArgs apply);

  std::uint32_t count_;
  std::uint32_t max_iterations_;
  float tolerance_;
  Kernel<ViscousBeginArgs> begin_;
  Kernel<ViscousApplyArgs> apply_;
  Kernel<ViscousSumArgs> sum_;
  Kernel<ViscousSumArgs> choose_;
  Kernel<ViscousUpdateArgs> update_;
  Kernel<ViscousEndArgs> end_;
  Buffer<vec4> solution_;
  Buffer<vec4> residual_;
  Buffer<vec4> product_;
  Buffer<vec4> direction_;
  Buffer<vec4> image_;
  Buffer<vec3> sums_;
  Buffer<std::uint32_t> groups_;  ///< of the rounds' dispatches
  Buffer<SphViscous> solver_;
};

/// Velocities after a step of the parameters' fixed length under viscosity alone, m/s, in the order
/// of the particles; `iterations` of the solver.
///
/// Mathematics: cpu::sph_viscous_velocities.
struct SphViscousResult {
  std::vector<vec3> velocities;
  std::uint32_t iterations = 0;
};
SphViscousResult sph_viscous_velocities(Context& context, const SphProblem& problem);

}  // namespace parity::gpu
