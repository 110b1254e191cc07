#pragma once

#include <stdexcept>
#include <string>

namespace parity {

/// A file that is missing, malformed or unsupported. One line: file, place (line, byte or JSON
/// path), value, and what was expected. The program turns it into exit code 2.
class InputError : public std::runtime_error {
 public:
  InputError(const std::string& file, const std::string& what)
      : std::runtime_error(file + ": " + what) {}
  InputError(const std::string& file, std::size_t line, const std::string& what)
      : std::runtime_error(file + ":" + std::to_string(line) + ": " + what) {}
};

}  // namespace parity
