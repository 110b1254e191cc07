#pragma once

#include <cstdint>
#include <vector>

#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "shaders/raster/layout.h"

namespace parity::gpu {

/// Exclusive prefix sums of unsigned integers (modulo 2^32), in place: blocks are summed, their
/// sums scanned the same way, and added to the scans of the blocks. Any device gives the same bits.
///
/// Source: Blelloch 1990.
class PrefixSum {
 public:
  /// @param capacity  most values that one record() gets.
  PrefixSum(Context& context, std::size_t capacity);

  /// @throws std::invalid_argument  count is over the capacity.
  void record(Commands& commands, BufferRef<std::uint32_t> values, std::uint32_t count);

 private:
  void scan(Commands& commands, BufferRef<std::uint32_t> values, std::uint32_t count,
            std::size_t level);

  std::size_t capacity_;
  Kernel<ScanArgs> sum_;
  Kernel<ScanArgs> scan_;
  std::vector<Buffer<std::uint32_t>> sums_;  ///< of the blocks, level after level
};

}  // namespace parity::gpu
