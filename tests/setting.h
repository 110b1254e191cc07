#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace parity {

/// A knob of a stage and the range in which it is held to its word.
struct Axis {
  std::string name = {};   ///< snake_case
  std::string unit = "1";  ///< "px", "m", "1" for counts and ratios
  double low = 0;          ///< both ends are checked: choose them where the method may break
  double high = 1;
  double standard = 0;
  bool logarithmic = false;  ///< steps are equal in the logarithm
  bool whole = false;        ///< only whole numbers
  bool each = false;         ///< its whole numbers (logarithmic: doublings) stand for kinds
};

/// A value for each axis of a stage, and the seed of what is random.
class Setting {
 public:
  Setting() = default;
  /// The standard value of each axis.
  explicit Setting(std::span<const Axis> axes);

  /// @throws std::invalid_argument  there is no such axis.
  double at(const std::string& axis) const;
  /// The same rounded to the next whole number.
  int count(const std::string& axis) const;
  /// @throws std::invalid_argument  there is no such axis.
  void set(const std::string& axis, double value);

  const std::vector<std::pair<std::string, double>>& values() const { return values_; }
  std::uint64_t seed = 1;

  /// "width=131 samples=4"; empty without axes.
  std::string text() const;

 private:
  std::vector<std::pair<std::string, double>> values_;
};

/// A setting to check, and how it differs from the standard one: "standard" or "width=131".
struct NamedSetting {
  std::string name;
  Setting setting;
};

/// The standard setting and both ends of every axis, without repetition. Of axes of kinds and those
/// of at most four whole numbers every value.
std::vector<NamedSetting> conformance_settings(std::span<const Axis> axes);

/// `count` values from low to high, both included; fewer where whole numbers coincide.
std::vector<double> steps_along(const Axis& axis, int count);

/// A number as people write it: "131", "0.25", "1e-07".
std::string short_number(double value);

}  // namespace parity
