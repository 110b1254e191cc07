#pragma once

#include <vector>

#include "gpu/sph/density.h"

namespace parity::gpu {

/// Gradients of vectors that particles carry, by kernels corrected to be exact for linear fields:
/// for what is asked of a flow, such as vorticity and strain. No force uses them. Forces are sums
/// over pairs, equal and opposite, so that momentum is kept; corrected kernels of two particles
/// differ, and would not keep it.
///
/// Source: Randles & Libersky 1996; Bonet & Lok 1999.
class Gradients {
 public:
  Gradients(Context& context, const SphProblem& problem, const SphConstants& constants);

  /// @param field  sorted.
  void record(Commands& commands, const Neighbours& neighbours, const Densities& densities,
              BufferRef<vec4> field);

  /// By id; columns: derivatives along x, y, z.
  const Buffer<mat3>& gradients() const { return gradients_; }

 private:
  std::uint32_t count_;
  Kernel<GradientArgs> gradient_;
  Buffer<mat3> gradients_;
};

/// Gradients of the velocities, 1/s, in the order of the particles.
///
/// Mathematics: cpu::sph_velocity_gradients.
std::vector<mat3> sph_velocity_gradients(Context& context, const SphProblem& problem);

}  // namespace parity::gpu
