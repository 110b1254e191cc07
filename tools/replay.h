#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/conformance.h"

namespace parity::tools {

/// A failed check as a file holds it, enough to run it again.
struct Replay {
  std::string stage;
  Setting setting;
  std::vector<double> problem;  ///< as Stage::problem_numbers gives them
};

/// Writes DIR/<stage>-<setting>.json: stage, setting, seed, device, tolerance, what was wrong, the
/// numbers of the problem, each method's answer, and answer minus that of its judge. Numbers that
/// are many or not finite go to a .bin beside it (float64, little-endian), which the JSON
/// describes.
///
/// @return  path of the JSON.
/// @throws OutputError  a file cannot be written.
std::filesystem::path write_replay(const std::filesystem::path& folder, const Check& check,
                                   const CheckResult& result, const std::string& device);

/// @throws InputError  missing, not such a file, numbers missing, or no such stage or axis here.
Replay read_replay(const std::filesystem::path& file);

}  // namespace parity::tools
