#include "gpu/raster/radix_sort.h"

#include <stdexcept>
#include <string>

#include "shaders.h"

namespace parity::gpu {
namespace {

constexpr std::uint32_t digits = 256;

/// Pairs that one thread sorts: many where threads are few.
std::uint32_t block_size(const Context& context) {
  return context.info().type == "cpu" ? 1024 : 128;
}

std::uint32_t blocks_of(std::uint32_t capacity, std::uint32_t block) {
  return capacity / block + (capacity % block != 0 ? 1 : 0);
}

}  // namespace

RadixSort::RadixSort(Context& context, std::uint32_t capacity)
    : capacity_(capacity),
      block_(block_size(context)),
      blocks_(blocks_of(capacity, block_)),
      count_(context, shaders::raster_radix_count_comp),
      scatter_(context, shaders::raster_radix_scatter_comp),
      prefix_sum_(context, std::size_t{digits} * blocks_),
      counters_(context, std::size_t{digits} * blocks_),
      other_keys_(context, capacity),
      other_values_(context, capacity) {}

void RadixSort::record(Commands& commands, BufferRef<std::uint32_t> count,
                       const Buffer<std::uint32_t>& keys, const Buffer<std::uint32_t>& values,
                       std::uint32_t key_bits) {
  if (keys.count() < capacity_ || values.count() < capacity_)
    throw std::invalid_argument("RadixSort::record: buffers of " + std::to_string(keys.count()) +
                                " keys and " + std::to_string(values.count()) +
                                " values, must hold " + std::to_string(capacity_));
  if (capacity_ == 0) return;
  // An even number of passes ends where it began.
  const std::uint32_t passes = key_bits <= 16 ? 2 : 4;
  RadixArgs args{.count = count,
                 .keys = keys,
                 .values = values,
                 .sorted_keys = other_keys_,
                 .sorted_values = other_values_,
                 .counters = counters_,
                 .capacity = capacity_,
                 .blocks = blocks_,
                 .block = block_,
                 .shift = 0};
  for (std::uint32_t pass = 0; pass < passes; ++pass) {
    args.shift = 8 * pass;
    commands.dispatch(count_, {blocks_}, args);
    prefix_sum_.record(commands, counters_, digits * blocks_);
    commands.dispatch(scatter_, {blocks_}, args);
    std::swap(args.keys, args.sorted_keys);
    std::swap(args.values, args.sorted_values);
  }
}

}  // namespace parity::gpu
