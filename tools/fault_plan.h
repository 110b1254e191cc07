#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace parity::tools {

/// A known mistake to plant into the source, and the tests that must notice it.
struct Fault {
  std::string name;         ///< "missing top-left rule"
  std::string file;         ///< relative to the source folder
  std::string text;         ///< what stands there, exactly once
  std::string replacement;  ///< what is planted
  std::string tests;        ///< GoogleTest filter; or
  std::string checks;       ///< patterns of parity check, with spaces between them
};

/// The seeded faults of a file: an array of objects with these keys, `tests` or
/// `checks` left out.
///
/// @throws InputError  missing, malformed, or a name that occurs twice.
std::vector<Fault> read_faults(const std::filesystem::path& file);

/// The file's text with the fault planted.
///
/// @throws std::invalid_argument  the text to replace does not stand there exactly once.
std::string planted(const Fault& fault, const std::string& text);

/// Names of the tests or checks that failed, from the output of GoogleTest or parity check; each
/// once, in order.
std::vector<std::string> failed_tests(const std::string& output);

}  // namespace parity::tools
