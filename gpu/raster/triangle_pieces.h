#pragma once

#include <cstdint>

#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "gpu/raster/prefix_sum.h"
#include "shaders/raster/layout.h"

namespace parity::gpu {

/// Triangles clipped, culled and snapped to fixed point: one piece a triangle that needs no
/// clipping, room for eight of one that does, in the order of the source.
///
/// Mathematics: notes 1.1, 1.2, 1.4.
class TrianglePieces {
 public:
  /// @param triangle_capacity  most triangles of one record().
  TrianglePieces(Context& context, const RasterTarget& target, std::uint32_t depth_mode,
                 std::uint32_t triangle_capacity);

  /// @throws std::invalid_argument  more triangles than the capacity, or first_element is 0.
  void record(Commands& commands, const TriangleSource& source);

  /// After each run: true if all pieces had room. Else the room has been enlarged: record again.
  bool fit(Context& context);

  /// The first count() of pieces() are valid.
  const Buffer<TrianglePiece>& pieces() const { return pieces_; }
  const Buffer<std::uint32_t>& count() const { return count_; }
  std::uint32_t capacity() const { return std::uint32_t(pieces_.count()); }

 private:
  RasterTarget target_;
  std::uint32_t depth_mode_;
  std::uint32_t triangle_capacity_;
  Kernel<PieceCountArgs> count_pieces_;
  Kernel<PieceSetupArgs> set_up_;
  PrefixSum prefix_sum_;
  Buffer<std::uint32_t> offsets_;
  Buffer<std::uint32_t> count_;
  Buffer<TrianglePiece> pieces_;
};

}  // namespace parity::gpu
