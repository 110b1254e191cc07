#pragma once

#include <vector>

#include "gpu/sph/neighbours.h"

namespace parity::gpu {

/// Places with densities, and velocities with pressures by the equation of state: what the passes
/// after it read. The sums over neighbours are made where neighbours are found.
///
/// Source: notes 10.4; Akinci et al. 2012 (walls); Monaghan 1994 (Tait).
class Densities {
 public:
  Densities(Context& context, const SphConstants& constants);

  /// @param velocities  by id.
  void record(Commands& commands, const Neighbours& neighbours, BufferRef<vec4> velocities);

  /// Sorted; w: density.
  const Buffer<vec4>& places() const { return places_; }
  /// Sorted velocities; w: pressure over density squared.
  const Buffer<vec4>& motions() const { return motions_; }

 private:
  std::uint32_t count_;
  Kernel<DensityArgs> density_;
  Buffer<vec4> places_;
  Buffer<vec4> motions_;
};

/// Densities, kg/m^3, in the order of the particles.
///
/// Mathematics: cpu::sph_densities.
std::vector<float> sph_densities(Context& context, const SphProblem& problem);

}  // namespace parity::gpu
