#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace parity {

/// A rectangle of values, row-major, row 0 on top. Images, depth buffers and fields are grids.
template <typename T>
class Grid {
 public:
  Grid() = default;

  /// @throws std::invalid_argument  a side is negative.
  Grid(int width, int height, T value = T{}) : width_(width), height_(height) {
    if (width < 0 || height < 0)
      throw std::invalid_argument("Grid: size is " + std::to_string(width) + "x" +
                                  std::to_string(height) + ", must not be negative");
    values_.assign(std::size_t(width) * std::size_t(height), value);
  }

  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t size() const { return values_.size(); }
  bool empty() const { return values_.empty(); }

  T& operator()(int x, int y) {
    return values_[std::size_t(y) * std::size_t(width_) + std::size_t(x)];
  }
  const T& operator()(int x, int y) const {
    return values_[std::size_t(y) * std::size_t(width_) + std::size_t(x)];
  }

  T* data() { return values_.data(); }
  const T* data() const { return values_.data(); }
  std::vector<T>& values() { return values_; }
  const std::vector<T>& values() const { return values_; }
  auto begin() { return values_.begin(); }
  auto end() { return values_.end(); }
  auto begin() const { return values_.begin(); }
  auto end() const { return values_.end(); }

  bool operator==(const Grid&) const = default;

 private:
  int width_ = 0;
  int height_ = 0;
  std::vector<T> values_;
};

}  // namespace parity
