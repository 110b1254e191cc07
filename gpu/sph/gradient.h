#pragma once

#include <vector>

#include "gpu/sph/density.h"

namespace parity::gpu {

/// Gradients of vectors that particles carry, by kernels corrected to be exact for linear fields.
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
