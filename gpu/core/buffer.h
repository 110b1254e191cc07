#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "gpu/core/context.h"
#include "shaders/shared.h"

namespace parity::gpu {

/// Bytes on the device. Use Buffer<T>.
///
/// With Guard::zones it lies between zones of 256 bytes of 0xCD that Context::run checks after
/// every submission. With Guard::fences (CPU drivers) its last byte is the last of a page and the
/// next cannot be touched: the first stray access ends the process. In both, new bytes and, where
/// the host reaches them, those given back are 0xCD, which reads as nonsense, never as 0.
class RawBuffer {
 public:
  RawBuffer();
  RawBuffer(Context& context, std::size_t bytes, std::size_t element_bytes);
  ~RawBuffer();
  RawBuffer(RawBuffer&& other) noexcept;
  RawBuffer& operator=(RawBuffer&& other) noexcept;

  void write(const void* source, std::size_t byte_offset, std::size_t bytes);
  void read(void* target, std::size_t byte_offset, std::size_t bytes) const;
  std::size_t bytes() const;
  std::uint64_t address() const;

  struct State;  // for gpu/core only
  State* state() const { return state_.get(); }

 private:
  std::unique_ptr<State> state_;
};

namespace detail {
/// The product, or the largest number if that is too small for it.
constexpr std::size_t saturating_product(std::size_t a, std::size_t b) {
  return b != 0 && a > SIZE_MAX / b ? SIZE_MAX : a * b;
}
}  // namespace detail

/// `count` elements on the device; move-only. Usable as storage (through its address), index,
/// indirect, and source and target of copies. A buffer of 0 elements is fine: its address must not
/// be read from.
///
/// @throws Error  out of memory, or larger than DeviceInfo::max_buffer_bytes.
template <typename T>
class Buffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  Buffer() = default;
  Buffer(Context& context, std::size_t count)
      : raw_(context, detail::saturating_product(count, sizeof(T)), sizeof(T)), count_(count) {}
  Buffer(Context& context, std::span<const T> values) : Buffer(context, values.size()) {
    write(values);
  }
  Buffer(Context& context, const std::vector<T>& values)
      : Buffer(context, std::span<const T>(values)) {}

  /// Waits for nothing: call between runs.
  void write(std::span<const T> values, std::size_t first = 0) {
    check(first, values.size(), "write");
    raw_.write(values.data(), first * sizeof(T), values.size_bytes());
  }
  std::vector<T> read() const { return read(0, count_); }
  std::vector<T> read(std::size_t first, std::size_t count) const {
    check(first, count, "read");
    std::vector<T> values(count);
    raw_.read(values.data(), first * sizeof(T), count * sizeof(T));
    return values;
  }

  std::size_t count() const { return count_; }
  BufferRef<T> ref(std::size_t first = 0) const { return {raw_.address() + first * sizeof(T)}; }
  operator BufferRef<T>() const { return ref(); }
  const RawBuffer& raw() const { return raw_; }

 private:
  void check(std::size_t first, std::size_t count, const char* what) const {
    if (first > count_ || count > count_ - first)
      throw std::invalid_argument(std::string("Buffer::") + what + ": elements " +
                                  std::to_string(first) + " to " + std::to_string(first + count) +
                                  " of " + std::to_string(count_));
  }

  RawBuffer raw_;
  std::size_t count_ = 0;
};

}  // namespace parity::gpu
