#pragma once

#include <stdexcept>
#include <string>

namespace parity {

/// A file that could not be written: name and reason in one line. The program turns it into exit
/// code 5.
class OutputError : public std::runtime_error {
 public:
  OutputError(const std::string& file, const std::string& what)
      : std::runtime_error(file + ": " + what) {}
};

}  // namespace parity
