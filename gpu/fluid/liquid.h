#pragma once

#include "gpu/fluid/fluid_buffers.h"
#include "gpu/raster/radix_sort.h"

namespace parity::gpu {

/// The particles of a liquid (FLIP, APIC): sorted by cell every step, ids of a cell in order, so
/// that sums have one order and a resumed run has the same bits. Memory: 80 bytes a particle with
/// APIC's gradients and the sorter's keys, 8 bytes a cell.
///
/// Mathematics: cpu::liquid_step.
class Liquid {
 public:
  Liquid(Context& context, FluidBuffers& buffers, const FluidProblem& problem);
  void write(const LiquidParticles& particles);
  LiquidParticles read() const;

  /// Particles by cell, and where each cell has its own.
  void record_sort(Commands& commands);
  /// Gives faces the velocity of the sorted particles around; kept in buffers.other too.
  void record_to_grid(Commands& commands);
  void record_forces(Commands& commands);
  /// Takes the new velocity back and moves.
  void record_to_particles(Commands& commands);

  /// First particle and one behind the last, of each cell.
  const Buffer<std::uint32_t>& ranges() const { return ranges_; }
  const Buffer<vec3>& positions() const { return positions_; }
  const Buffer<vec3>& velocities() const { return velocities_; }
  std::uint32_t count() const { return count_; }

 private:
  LiquidArgs args() const;

  FluidBuffers& buffers_;
  std::uint32_t count_;
  std::uint32_t key_bits_;
  Buffer<vec3> positions_, velocities_;
  Buffer<mat3> gradients_;
  Buffer<std::uint32_t> keys_, sorted_, ranges_, count_buffer_;
  RadixSort sort_;
  Kernel<LiquidArgs> keys_kernel_, ranges_kernel_, to_faces_, forces_, to_particles_;
};

}  // namespace parity::gpu
