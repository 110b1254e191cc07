#pragma once

#include <CLI/CLI.hpp>
#include <stdexcept>
#include <string>

namespace parity::tools {

/// Holds a number between two, both allowed: infinity and what is no number are refused, which
/// CLI::Range and CLI::PositiveNumber let pass.
inline CLI::Validator within(double low, double high) {
  const std::string range = CLI::detail::to_string(low) + " to " + CLI::detail::to_string(high);
  return CLI::Validator(
      [low, high, range](std::string& text) -> std::string {
        double value = 0;
        if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high) return {};
        return "Value " + text + " not in range " + range;
      },
      "[" + range + "]");
}

/// @throws std::invalid_argument  a Vulkan device is named where none is used.
inline void check_device(const std::string& backend, const std::string& device) {
  if (backend == "cpu" && !device.empty())
    throw std::invalid_argument("--device is for --backend gpu");
}

}  // namespace parity::tools
