#pragma once

#include <vector>

#include "gpu/sph/density.h"

namespace parity::gpu {

/// Accelerations of particles by pressure, viscosity, surface tension, walls and gravity.
///
/// Source: notes 10.4; Monaghan 1992, 2005; Becker & Teschner 2007; Akinci et al. 2012.
class Forces {
 public:
  Forces(Context& context, const SphProblem& problem, const SphConstants& constants);

  void record(Commands& commands, const Neighbours& neighbours, const Densities& densities);

  /// Sorted.
  const Buffer<vec4>& accelerations() const { return accelerations_; }

 private:
  std::uint32_t count_;
  Kernel<ForceArgs> forces_;
  Buffer<vec4> accelerations_;
};

/// Accelerations, m/s^2, in the order of the particles.
///
/// Mathematics: cpu::sph_accelerations.
std::vector<vec3> sph_accelerations(Context& context, const SphProblem& problem);

}  // namespace parity::gpu
