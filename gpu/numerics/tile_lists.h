#pragma once

#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "shaders/numerics/layout.h"

namespace parity::gpu {

/// Which tiles of a box are worked on, as lists that kernels are dispatched over. Memory: 24 bytes
/// a tile of 8 x 4 x 4 cells.
class TileLists {
 public:
  TileLists(Context& context, uvec3 cells);

  /// Lists from flags, in the order of flags; does nothing where the float at `clock` is 0.
  void record(Commands& commands, BufferRef<float> clock);
  /// All tiles are active and listed.
  void activate_all(Context& context);
  /// From now on lists have all tiles of the box, active or not.
  void visit_all();

  /// Over the workgroups that `cover` names: a tile_... constant of the layout.
  template <typename Args>
  void dispatch(Commands& commands, const Kernel<Args>& kernel, std::uint32_t cover,
                const Args& args) const {
    commands.dispatch_indirect(kernel, groups_, cover, args);
  }

  uvec3 tiles() const { return tiles_; }
  std::uint32_t tile_count() const { return tiles_.x * tiles_.y * tiles_.z; }
  BufferRef<TileTable> table() const { return table_; }
  const Buffer<std::uint32_t>& flags() const { return flags_; }
  /// Count of active tiles.
  std::uint32_t active_count() const { return groups_.read()[active_tiles]; }

 private:
  uvec3 tiles_;
  bool is_flat_;
  Buffer<std::uint32_t> flags_, list_, groups_, starts_;
  Buffer<TileTable> table_;
  Kernel<TileListArgs> list_kernel_;
};

}  // namespace parity::gpu
