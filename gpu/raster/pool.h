#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "gpu/core/buffer.h"

namespace parity::gpu {

/// Arrays gathered into few buffers, none larger than it need be. Add all, upload once, then take
/// addresses.
template <typename T>
class Pool {
 public:
  /// Where an array lies.
  struct Slice {
    std::size_t buffer = 0;
    std::size_t first = 0;
    std::size_t count = 0;
  };

  /// @param buffer_bytes  a new buffer begins where one would grow beyond; a longer array gets one
  ///                      of its own.
  explicit Pool(std::size_t buffer_bytes) : capacity_(buffer_bytes / sizeof(T)) {}

  Slice add(std::span<const T> values) {
    if (arrays_.empty() ||
        (!arrays_.back().empty() && arrays_.back().size() + values.size() > capacity_))
      arrays_.emplace_back();
    std::vector<T>& array = arrays_.back();
    const Slice slice{arrays_.size() - 1, array.size(), values.size()};
    array.insert(array.end(), values.begin(), values.end());
    return slice;
  }

  void upload(Context& context) {
    for (const std::vector<T>& array : arrays_) buffers_.emplace_back(context, array);
    arrays_.clear();
  }

  const Buffer<T>& buffer(const Slice& slice) const { return buffers_[slice.buffer]; }
  BufferRef<T> ref(const Slice& slice) const { return buffer(slice).ref(slice.first); }

 private:
  std::size_t capacity_;
  std::vector<std::vector<T>> arrays_;
  std::vector<Buffer<T>> buffers_;
};

}  // namespace parity::gpu
