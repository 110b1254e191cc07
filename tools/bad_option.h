#pragma once

#include <stdexcept>
#include <string>

namespace parity::tools {

/// "--size is '3', must be WIDTHxHEIGHT".
inline std::invalid_argument bad_option(const char* option, const std::string& value,
                                        const char* expected) {
  return std::invalid_argument(std::string("--") + option + " is '" + value + "', must be " +
                               expected);
}

}  // namespace parity::tools
