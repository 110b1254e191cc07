#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "geometry/math.h"

namespace parity::tools {

/// Appends values as they lie in memory.
class ByteWriter {
 public:
  template <typename T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&v), sizeof v);
  }
  void text(std::string_view text) {
    value(std::uint64_t(text.size()));
    bytes_.append(text);
  }
  template <typename T>
  void list(std::span<const T> values) {
    value(std::uint64_t(values.size()));
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  }
  template <typename T>
  void list(const std::vector<T>& values) {
    list(std::span<const T>(values));
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Takes the same values off again; trusts nothing.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  /// @throws std::runtime_error  cut short.
  template <typename T>
  T value() {
    T v;
    std::memcpy(&v, take(sizeof v).data(), sizeof v);
    return v;
  }
  std::string_view text() {
    const auto size = value<std::uint64_t>();
    return take(size);
  }
  /// @throws std::runtime_error  not `count` numbers, or one of them is not finite.
  template <typename T>
  std::vector<T> list(std::size_t count, const char* what) {
    const auto size = value<std::uint64_t>();
    if (size != count)
      throw std::runtime_error("has " + std::to_string(size) + " " + what + ", must have " +
                               std::to_string(count));
    std::vector<T> values(count);
    if (rest_.size() / sizeof(T) < count) throw std::runtime_error("is cut short");
    std::memcpy(values.data(), take(count * sizeof(T)).data(), count * sizeof(T));
    for (const T& v : values) check_finite(v, what);
    return values;
  }
  /// How many numbers the list has that comes next.
  std::uint64_t peek_count() const { return ByteReader(rest_).value<std::uint64_t>(); }
  bool is_at_end() const { return rest_.empty(); }

 private:
  std::string_view take(std::uint64_t size) {
    if (size > rest_.size()) throw std::runtime_error("is cut short");
    const std::string_view part = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return part;
  }
  template <typename T>
  static void check_finite(const T& v, const char* what) {
    if constexpr (std::is_arithmetic_v<T>) {
      if (!std::isfinite(double(v)))
        throw std::runtime_error(std::string("has ") + what + " that are not finite");
    } else {
      for (int i = 0; i < T::length(); ++i) check_finite(v[i], what);
    }
  }

  std::string_view rest_;
};

}  // namespace parity::tools
