#pragma once

#include "gpu/fluid/fluid_buffers.h"

namespace parity::gpu {

/// Chooses the tiles that a step works on from what the last one left in them, and empties the
/// others. Only tiles of the last step are looked through. Time follows the active tiles, but for
/// the coarse grids of the pressure, about a hundredth of a dense step; memory is that of the box.
///
/// Mathematics: sim/fluid.h, active_cells; cpu::choose_active.
class ActiveTiles {
 public:
  ActiveTiles(Context& context, const FluidBuffers& buffers, const FluidProblem& problem);

  /// Lists from smoke, heat and speed, or from the ranges of a liquid's particles.
  void record_choice(Commands& commands, BufferRef<float> smoke, BufferRef<float> temperature,
                     BufferRef<std::uint32_t> ranges);
  /// Zeros for the points of tiles that were left.
  void record_clear_faces(Commands& commands);
  /// @param numbers  a cell; 0: quads of cells as the pressure is stored.
  void record_clear(Commands& commands, BufferRef<float> field, std::uint32_t numbers);
  /// Of each cell.
  std::vector<std::uint8_t> read_active() const;

 private:
  const FluidBuffers& buffers_;
  bool is_liquid_;
  Buffer<std::uint32_t> held_, busy_;
  Kernel<FluidTileArgs> busy_kernel_, flags_kernel_;
  Kernel<FluidArgs> clear_kernel_;
};

}  // namespace parity::gpu
