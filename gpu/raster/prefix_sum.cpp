#include "gpu/raster/prefix_sum.h"

#include <stdexcept>
#include <string>

#include "shaders.h"

namespace parity::gpu {
namespace {

constexpr std::uint32_t block = 256;

std::uint32_t blocks_of(std::size_t count) {
  return static_cast<std::uint32_t>((count + block - 1) / block);
}

}  // namespace

PrefixSum::PrefixSum(Context& context, std::size_t capacity)
    : capacity_(capacity),
      sum_(context, shaders::raster_prefix_block_sum_comp),
      scan_(context, shaders::raster_prefix_scan_comp) {
  for (std::size_t count = capacity; count > block; count = sums_.back().count())
    sums_.emplace_back(context, blocks_of(count));
}

void PrefixSum::record(Commands& commands, BufferRef<std::uint32_t> values, std::uint32_t count) {
  if (count > capacity_)
    throw std::invalid_argument("PrefixSum::record: count is " + std::to_string(count) +
                                ", capacity is " + std::to_string(capacity_));
  if (count > 0) scan(commands, values, count, 0);
}

void PrefixSum::scan(Commands& commands, BufferRef<std::uint32_t> values, std::uint32_t count,
                     std::size_t level) {
  const std::uint32_t blocks = blocks_of(count);
  ScanArgs args{.values = values, .sums = {}, .count = count, .block = block};
  if (blocks > 1) {
    args.sums = sums_[level];
    commands.dispatch(sum_, {blocks}, args);
    scan(commands, sums_[level], blocks, level + 1);
  }
  commands.dispatch(scan_, {blocks}, args);
}

}  // namespace parity::gpu
