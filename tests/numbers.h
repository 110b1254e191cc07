#pragma once

#include <concepts>
#include <cstddef>
#include <ranges>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "geometry/math.h"
#include "geometry/raster.h"
#include "geometry/transform.h"

/// Every problem and every answer is a list of numbers in a fixed order; so the harness can write
/// them to a file, put them back, perturb them and look for NaN, whatever their type.
namespace parity {

/// How a struct joins in: a `fields_of(const T*)` beside it that returns its members' addresses as
/// a tuple. Those of the geometry folder stand here.
inline auto fields_of(const Trs*) {
  return std::tuple{&Trs::translation, &Trs::rotation, &Trs::scale};
}
inline auto fields_of(const AxisAngle*) { return std::tuple{&AxisAngle::axis, &AxisAngle::angle}; }
inline auto fields_of(const LookAt*) {
  return std::tuple{&LookAt::eye, &LookAt::center, &LookAt::up};
}
inline auto fields_of(const ViewVolume*) {
  return std::tuple{&ViewVolume::left, &ViewVolume::right, &ViewVolume::bottom,
                    &ViewVolume::top,  &ViewVolume::near,  &ViewVolume::far};
}
inline auto fields_of(const SlerpProblem*) {
  return std::tuple{&SlerpProblem::from, &SlerpProblem::to, &SlerpProblem::t};
}
inline auto fields_of(const TriangleList*) {
  return std::tuple{&TriangleList::width, &TriangleList::height,         &TriangleList::samples,
                    &TriangleList::cull,  &TriangleList::clip_positions, &TriangleList::triangles};
}
inline auto fields_of(const Coverage*) { return std::tuple{&Coverage::count, &Coverage::last}; }
inline auto fields_of(const Varyings*) {
  return std::tuple{&Varyings::values, &Varyings::perspective};
}
inline auto fields_of(const DepthImage*) {
  return std::tuple{&DepthImage::depth, &DepthImage::front};
}
inline auto fields_of(const Segment*) { return std::tuple{&Segment::begin, &Segment::end}; }
inline auto fields_of(const Polygon*) { return std::tuple{&Polygon::rings}; }

namespace detail {

template <typename T>
concept Number = std::is_arithmetic_v<T> || std::is_enum_v<T>;

template <typename T>
concept GlmType = requires(T& value) {
  typename T::value_type;
  { T::length() } -> std::convertible_to<int>;
  value[0];
}
&&!std::ranges::range<T>;

template <typename T>
concept HasFields = requires(const T* value) {
  fields_of(value);
};

}  // namespace detail

/// Calls `visit` with a reference to each number of `value`, depth first, in the order of storage.
template <typename T, typename Visit>
void visit_numbers(T& value, const Visit& visit) {
  using Plain = std::remove_const_t<T>;
  if constexpr (detail::Number<Plain>) {
    visit(value);
  } else if constexpr (detail::GlmType<Plain>) {
    for (int i = 0; i < Plain::length(); ++i) visit_numbers(value[i], visit);
  } else if constexpr (std::ranges::range<Plain>) {
    for (auto& element : value) visit_numbers(element, visit);
  } else {
    static_assert(detail::HasFields<Plain>, "give the struct a fields_of(const T*), see numbers.h");
    std::apply([&](auto... field) { (visit_numbers(value.*field, visit), ...); },
               fields_of(static_cast<const Plain*>(nullptr)));
  }
}

/// All numbers of a value as doubles; 64-bit integers above 2^53 are rounded.
template <typename T>
std::vector<double> numbers_of(const T& value) {
  std::vector<double> numbers;
  visit_numbers(value, [&](const auto& number) { numbers.push_back(static_cast<double>(number)); });
  return numbers;
}

/// Overwrites all numbers of a value, in the order of numbers_of.
///
/// @throws std::invalid_argument  the count is not that of the value.
template <typename T>
void set_numbers(T& value, std::span<const double> numbers) {
  std::size_t count = 0;
  visit_numbers(value, [&](auto&) { ++count; });
  if (count != numbers.size())
    throw std::invalid_argument("set_numbers: " + std::to_string(numbers.size()) +
                                " numbers for a value of " + std::to_string(count));
  std::size_t next = 0;
  visit_numbers(value, [&](auto& number) {
    number = static_cast<std::remove_reference_t<decltype(number)>>(numbers[next++]);
  });
}

}  // namespace parity
