#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "tests/setting.h"

namespace parity {
namespace {

std::string known_axes(const std::vector<std::pair<std::string, double>>& values) {
  std::string names;
  for (const auto& [name, value] : values) names += (names.empty() ? "" : ", ") + name;
  return names.empty() ? "it has none" : "it has " + names;
}

std::vector<double> checked_values(const Axis& axis) {
  const bool few = axis.whole && !axis.logarithmic && axis.high - axis.low < 4;
  if (!axis.each && !few) return {axis.low, axis.high};
  std::vector<double> values;
  for (double value = axis.low; value <= axis.high; value += axis.logarithmic ? value : 1)
    values.push_back(value);
  return values;
}

}  // namespace

Setting::Setting(std::span<const Axis> axes) {
  for (const Axis& axis : axes) values_.emplace_back(axis.name, axis.standard);
}

double Setting::at(const std::string& axis) const {
  for (const auto& [name, value] : values_)
    if (name == axis) return value;
  throw std::invalid_argument("Setting: no axis " + axis + "; " + known_axes(values_));
}

int Setting::count(const std::string& axis) const {
  return static_cast<int>(std::lround(at(axis)));
}

void Setting::set(const std::string& axis, double value) {
  for (auto& [name, old] : values_)
    if (name == axis) {
      old = value;
      return;
    }
  throw std::invalid_argument("Setting: no axis " + axis + "; " + known_axes(values_));
}

std::string Setting::text() const {
  std::string text;
  for (const auto& [name, value] : values_)
    text += (text.empty() ? "" : " ") + name + "=" + short_number(value);
  return text;
}

std::vector<NamedSetting> conformance_settings(std::span<const Axis> axes) {
  std::vector<NamedSetting> settings{{"standard", Setting(axes)}};
  for (const Axis& axis : axes)
    for (double value : checked_values(axis)) {
      const std::string name = axis.name + "=" + short_number(value);
      if (value == axis.standard || settings.back().name == name) continue;
      settings.push_back({name, Setting(axes)});
      settings.back().setting.set(axis.name, value);
    }
  return settings;
}

std::vector<double> steps_along(const Axis& axis, int count) {
  std::vector<double> steps;
  for (int i = 0; i < count; ++i) {
    const double t = count > 1 ? static_cast<double>(i) / (count - 1) : 0.0;
    double value = axis.logarithmic ? axis.low * std::pow(axis.high / axis.low, t)
                                    : axis.low + t * (axis.high - axis.low);
    if (i == 0) value = axis.low;
    if (i > 0 && i == count - 1) value = axis.high;
    if (axis.whole) value = std::round(value);
    if (steps.empty() || value != steps.back()) steps.push_back(value);
  }
  return steps;
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  if (std::stod(text) != value) std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

}  // namespace parity
