#pragma once

#include <cstdint>
#include <vector>

#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "gpu/raster/radix_sort.h"
#include "shaders/sph/layout.h"
#include "sim/sph.h"

namespace parity::gpu {

/// Points sorted by (cell, id), and where each cell begins. Any device gives the same order.
class CellSort {
 public:
  /// @param walls  by the walls' grid.
  CellSort(Context& context, const SphConstants& constants, std::uint32_t count, bool walls);

  /// Sorts `positions`, of which there are as many as the count.
  void record(Commands& commands, BufferRef<SphConstants> constants, BufferRef<vec4> positions);

  /// Brings values of the points into their order.
  void record_gather(Commands& commands, BufferRef<vec4> from, BufferRef<vec4> to) const;

  const Buffer<std::uint32_t>& ids() const { return ids_; }
  const Buffer<std::uint32_t>& starts() const { return starts_; }
  const Buffer<vec4>& sorted() const { return sorted_; }

 private:
  std::uint32_t count_;
  std::uint32_t walls_;
  std::uint32_t cell_count_;
  std::uint32_t row_;   ///< cells
  std::uint32_t rows_;  ///< along y
  std::uint32_t key_bits_;
  Kernel<CellKeyArgs> cell_key_;
  Kernel<CellStartArgs> cell_start_;
  Kernel<GatherArgs> gather_;
  RadixSort sort_;
  Buffer<std::uint32_t> count_buffer_;
  Buffer<std::uint32_t> keys_;
  Buffer<std::uint32_t> ids_;
  Buffer<std::uint32_t> starts_;
  Buffer<vec4> sorted_;
};

/// Lists, of each particle, the particles of the fluid and of the walls within the support,
/// and its density, which is a sum over them.
///
/// Source: Green 2010, "Particle Simulation using CUDA".
class Neighbours {
 public:
  /// @param boundary  wall particles; sorted and weighed here.
  Neighbours(Context& context, const SphProblem& problem, const SphConstants& constants);

  void record(Commands& commands, BufferRef<vec4> positions);

  const Buffer<SphConstants>& constants() const { return constants_; }
  const CellSort& cells() const { return cells_; }
  /// Sorted; w: rest density times the volume that it stands for.
  const Buffer<vec4>& boundary() const { return boundary_; }
  /// Sorted velocities; w: share of the viscosity.
  const Buffer<vec4>& boundary_motions() const { return boundary_motions_; }
  const CellSort& boundary_cells() const { return boundary_cells_; }
  const Buffer<std::uint32_t>& lists() const { return lists_; }
  const Buffer<uvec2>& counts() const { return counts_; }
  /// Sorted, kg/m^3.
  const Buffer<float>& densities() const { return densities_; }

 private:
  void weigh_boundary(Context& context, const SphProblem& problem);

  std::uint32_t count_;
  Buffer<SphConstants> constants_;
  CellSort cells_;
  CellSort boundary_cells_;
  Kernel<NeighbourArgs> neighbours_;
  Buffer<vec4> boundary_;
  Buffer<vec4> boundary_motions_;
  Buffer<std::uint32_t> lists_;
  Buffer<uvec2> counts_;
  Buffer<float> densities_;
  Buffer<std::uint32_t> near_walls_;  ///< a bit a cell
};

/// Mathematics: cpu::sph_neighbours; the decision, r^2 < H^2 in float, is the same.
///
/// @throws std::invalid_argument  as check_sph_problem.
/// @throws Error                  a particle has more neighbours than a list holds.
SphNeighbourLists sph_neighbours(Context& context, const SphProblem& problem);

/// w = 0.
std::vector<vec4> with_zero(const std::vector<vec3>& points);

}  // namespace parity::gpu
