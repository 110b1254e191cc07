#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/raster.h"
#include "gpu/core/context.h"
#include "gpu/raster/radix_sort.h"

namespace parity::gpu {

/// Sorts depths on the device, far (great) to near, stable; for renderers that draw in order.
///
/// Source: notes 1.7.
class PainterOrder {
 public:
  /// @param capacity  most depths that one record() gets.
  PainterOrder(Context& context, std::uint32_t capacity);

  /// @param depths  `count` numbers, none NaN.
  /// @throws std::invalid_argument  count is over the capacity.
  void record(Commands& commands, BufferRef<float> depths, std::uint32_t count);

  /// The first `count` are the numbers of the depths in order, after the run.
  const Buffer<std::uint32_t>& order() const { return values_; }

 private:
  std::uint32_t capacity_;
  Kernel<FloatKeyArgs> keys_of_;
  RadixSort sort_;
  Buffer<std::uint32_t> count_;
  Buffer<std::uint32_t> keys_;
  Buffer<std::uint32_t> values_;
};

/// Numbers of the keys from the greatest (farthest) to the least; equal keys (0 and -0 too) keep
/// their order.
///
/// @throws std::invalid_argument  a key is NaN.
std::vector<std::uint32_t> painter_order(Context& context, std::span<const float> keys);

/// What is seen if triangles are painted from far to near by the mean w of their corners, without a
/// depth test; depth is z/w, and 1 where nothing is. One sample a pixel, whatever the list
/// says; Snapping::mesa.
///
/// @throws std::invalid_argument  as edge_coverage, or the w of a corner is NaN.
///
/// Source: notes 1.7. Wrong where triangles pierce or overlap in a cycle.
DepthImage painter(Context& context, const TriangleList& list);

}  // namespace parity::gpu
