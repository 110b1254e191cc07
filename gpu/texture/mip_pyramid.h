#pragma once

#include <cstdint>
#include <vector>

#include "geometry/grid.h"
#include "geometry/math.h"
#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "shaders/texture/layout.h"

namespace parity::gpu {

/// Makes the levels of mip pyramids on the device.
///
/// Mathematics: cpu::mip_pyramid; means are handed from level to level in single precision.
/// Accuracy: codes of values that are off by less than 0.02 codes.
class MipPyramid {
 public:
  explicit MipPyramid(Context& context);

  /// Means of the levels on the way, for pyramids up to the size that it was made for.
  struct Scratch {
    Scratch(Context& context, int width, int height);
    Buffer<vec4> even, odd;
  };

  /// Fills levels 1..n behind level 0, or as many that there are `count` in all (and up to two
  /// more).
  ///
  /// @param codes  the first texel of level 0; the levels lie as mip_levels says.
  void record(Commands& commands, BufferRef<std::uint32_t> codes, int width, int height, bool srgb,
              const Scratch& scratch, std::size_t count = 99) const;

  /// Fills levels 1..3 below some rows of level 0, which need not lie before them. Both sides of
  /// level 0, the first row, and the count of rows are multiples of 8.
  void record_rows(Commands& commands, BufferRef<std::uint32_t> rows, int first, int count,
                   BufferRef<std::uint32_t> codes, int width, int height, bool srgb,
                   const Scratch& scratch) const;

  /// Fills levels next..count - 1 below level next - 1, whose means are in `scratch`, or, below
  /// level 0, its codes.
  void record_below(Commands& commands, std::size_t next, BufferRef<std::uint32_t> codes, int width,
                    int height, bool srgb, const Scratch& scratch, std::size_t count) const;

 private:
  Kernel<MipTripleArgs> linear_triple_, srgb_triple_;
  Kernel<MipLevelArgs> linear_first_, srgb_first_, linear_next_, srgb_next_;
};

/// How a pyramid lies in a buffer.
struct PyramidRoom {
  std::size_t head = 0;   ///< words before the first level, not written
  std::size_t first = 0;  ///< level that is kept
  std::size_t last = 99;  ///< at least first; coarser ones are not made
};

/// Levels of an image, RGBA8, one after another as mip_levels says.
///
/// Where level 0 is not kept and both its sides are multiples of 8, it comes to the device by bands
/// of rows, 1 MiB or 8 rows at a time. Of other sizes all levels to the last one are there until
/// the copy.
///
/// @throws std::invalid_argument  the image is empty; there is no first level.
Buffer<std::uint32_t> build_pyramid(Context& context, const MipPyramid& pyramid,
                                    const Grid<u8vec4>& image, bool srgb, PyramidRoom room);

/// Levels 0..n of an image. Mathematics: cpu::mip_pyramid.
std::vector<Grid<u8vec4>> mip_pyramid(Context& context, const Grid<u8vec4>& image, bool srgb);

}  // namespace parity::gpu
