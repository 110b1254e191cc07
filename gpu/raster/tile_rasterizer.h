#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/camera.h"
#include "geometry/raster.h"
#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "gpu/raster/prefix_sum.h"
#include "gpu/raster/radix_sort.h"
#include "gpu/raster/triangle_pieces.h"
#include "shaders/raster/layout.h"

namespace parity::gpu {

/// What a TileRasterizer is made for.
struct TileRasterizerOptions {
  int width = 0;    ///< 1 to 16384
  int height = 0;   ///< 1 to 16384
  int samples = 1;  ///< 1, 2, 4, 8 at the standard sample places
  Snapping snapping = Snapping::mesa;
  DepthMode depth = DepthMode::reverse_z;
  float near = 0;                       ///< m, logarithmic depth only
  float far = 0;                        ///< m, logarithmic depth only
  std::uint32_t triangle_capacity = 0;  ///< most triangles of one record(); at most 2^28
};

/// Rasterises triangles in compute kernels: clips in homogeneous space where a guard band is left,
/// snaps to fixed point, sorts (tile, triangle) pairs into the lists of 8x8-pixel tiles, then tests
/// all samples of each tile against its list with exact integer edge functions (top-left rule).
///
///     do {
///       context.run([&](Commands& commands) { rasterizer.record(commands, source); });
///     } while (!rasterizer.fit(context));
///
/// The answer depends on nothing but the input: no atomics; each list is in the order of the
/// triangles, so equal depths keep the first.
///
/// Source: notes 1.4, 1.5, 1.7; Vulkan 1.3, "Rasterization"; Pineda 1988; Laine & Karras 2011.
class TileRasterizer {
 public:
  /// @throws std::invalid_argument  an option outside its range.
  TileRasterizer(Context& context, const TileRasterizerOptions& options);

  const TileRasterizerOptions& options() const { return options_; }

  /// Lists of the tiles, then what is in front at each sample. Flags of a triangle: `triangle_*` of
  /// the layout. Clip positions are Vulkan's (y down, depth 0 to w); indices must be valid.
  void record(Commands& commands, const TriangleSource& source);

  /// The lists alone.
  void record_lists(Commands& commands, const TriangleSource& source);

  /// The lists, then, without a depth test, how many triangles cover each sample (`counts`, as many
  /// as elements()) and the last that does (elements()).
  void record_coverage(Commands& commands, const TriangleSource& source,
                       const Buffer<std::uint32_t>& counts);

  /// After each run: true if all pairs had room. Else the answer is of no use and the room has been
  /// enlarged: record again.
  bool fit(Context& context);

  /// Of sample s of pixel (x, y), at index (y width + x) samples + s: first_element + triangle, or
  /// 0 (first_element is at least 1), and depth in the convention of the options.
  const Buffer<std::uint32_t>& elements() const { return elements_; }
  const Buffer<float>& depths() const { return depths_; }

  /// The list of tile t = (y / 8) tiles_x + x / 8: tile_triangles() from tile_begins()[t] up to
  /// tile_begins()[t + 1], pieces of triangles in the order of the source. "raster/tile.glsl" reads
  /// them.
  const Buffer<std::uint32_t>& tile_begins() const { return begins_; }
  const Buffer<TileTriangle>& tile_triangles() const { return tile_triangles_; }
  std::uint32_t tiles_x() const { return target_.tiles_x; }
  std::uint32_t tile_count() const { return tile_count_; }

 private:
  void resize_pieces(Context& context);
  void resize_pairs(Context& context, std::uint32_t pairs);
  void raster(Commands& commands, const Kernel<TileRasterArgs>& kernel,
              BufferRef<std::uint32_t> counts);

  TileRasterizerOptions options_;
  RasterTarget target_{};
  std::uint32_t tile_count_ = 0;
  std::uint32_t held_ = 0;  ///< samples a thread
  std::uint32_t pair_capacity_ = 0;

  Kernel<TileCountArgs> count_;
  Kernel<TileEmitArgs> emit_;
  Kernel<TileSetupArgs> setup_;
  Kernel<TileRangeArgs> range_;
  Kernel<TileRasterArgs> visibility_;
  Kernel<TileRasterArgs> coverage_;
  TrianglePieces pieces_;
  std::optional<PrefixSum> prefix_sum_;
  std::optional<RadixSort> sort_;

  Buffer<std::uint32_t> offsets_;  ///< of the pairs of a piece
  Buffer<std::uint32_t> pair_count_;
  Buffer<std::uint32_t> keys_, values_;
  Buffer<TileTriangle> tile_triangles_;
  Buffer<std::uint32_t> begins_;
  Buffer<std::uint32_t> elements_;
  Buffer<float> depths_;
};

}  // namespace parity::gpu
