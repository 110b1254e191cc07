#pragma once

#include "gpu/sph/forces.h"

namespace parity::gpu {

/// Pressures under which no particle is denser than at rest after the step: relaxed Jacobi steps on
/// the unknown pressures, never below 0, until the average compression is within the tolerance and
/// the largest within ten times that.
///
/// Converges: the system is symmetric and positive semi-definite; Jacobi steps of one half of the
/// diagonal, from the pressures of the step before.
/// Source: Bender & Koschier 2015, 2017 (DFSPH); Ihmsen et al. 2014.
/// With SphMethod::divergence_free the same is done before for the rate of density of particles
/// inside the fluid, from no pressure, until a step would add no more compression than that.
/// Differs from the papers: pressures, not their increments, are the unknowns, so that they can
/// fall again; the wall share of boundary volumes; which particles are inside is told by density.
class PressureSolver {
 public:
  PressureSolver(Context& context, const SphProblem& problem, const SphConstants& constants);

  /// Velocities after the step of the clock, from the densities and the accelerations without
  /// pressure.
  ///
  /// @param pressures  by id, Pa: where to begin.
  void record(Commands& commands, const Neighbours& neighbours, const Densities& densities,
              const Forces& forces, BufferRef<SphClock> clock, BufferRef<float> pressures);

  /// Sorted velocities after the step; w: the compression that they lead to.
  const Buffer<vec4>& moved() const { return moved_; }
  /// Sorted: step times pressure over density squared.
  const Buffer<float>& impulses() const { return impulses_; }
  const Buffer<SphSolver>& solver() const { return solver_; }
  /// Of the divergence solve.
  const Buffer<SphSolver>& divergence_solver() const { return divergence_solver_; }

 private:
  void record_rounds(Commands& commands, const SolveArgs& args);

  std::uint32_t count_;
  std::uint32_t max_iterations_;
  float tolerance_;
  bool is_divergence_free_;
  Kernel<SolveBeginArgs> begin_;
  Kernel<SolvePredictArgs> predict_;
  Kernel<SolveArgs> move_;
  Kernel<SolveArgs> press_;
  Kernel<SolveCheckArgs> check_;
  Kernel<SolveCheckArgs> stop_;
  Buffer<float> impulses_;
  Buffer<vec4> predicted_;
  Buffer<vec4> moved_;
  Buffer<vec2> sums_;
  Buffer<std::uint32_t> groups_;  ///< of the rounds' dispatches
  Buffer<SphSolver> solver_;
  Buffer<SphSolver> divergence_solver_;
};

/// Velocities after one step of the parameters' fixed length, m/s, by the order of the particles.
///
/// Mathematics: cpu::sph_incompressible_velocities.
std::vector<vec3> sph_incompressible_velocities(Context& context, const SphProblem& problem);

}  // namespace parity::gpu
