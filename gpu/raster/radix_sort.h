#pragma once

#include <cstdint>

#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "gpu/raster/prefix_sum.h"
#include "shaders/raster/layout.h"

namespace parity::gpu {

/// Stable sort of (key, value) pairs of unsigned integers, least digit first, 8 bits a pass: each
/// block counts its digits, the counts are scanned, each block scatters in order. No atomics.
///
/// Source: notes 1.7 (painter's algorithm); Satish, Harris & Garland 2009.
class RadixSort {
 public:
  /// @param capacity  most pairs that one record() gets.
  RadixSort(Context& context, std::uint32_t capacity);

  /// Sorts the first min(count[0], capacity) pairs in place. Keys are below 2^key_bits.
  ///
  /// @throws std::invalid_argument  a buffer is smaller than the capacity.
  void record(Commands& commands, BufferRef<std::uint32_t> count, const Buffer<std::uint32_t>& keys,
              const Buffer<std::uint32_t>& values, std::uint32_t key_bits);

 private:
  std::uint32_t capacity_;
  std::uint32_t block_;  ///< pairs a thread
  std::uint32_t blocks_;
  Kernel<RadixArgs> count_;
  Kernel<RadixArgs> scatter_;
  PrefixSum prefix_sum_;
  Buffer<std::uint32_t> counters_;
  Buffer<std::uint32_t> other_keys_;
  Buffer<std::uint32_t> other_values_;
};

}  // namespace parity::gpu
