#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

namespace parity {

/// A file or folder of the shared data: below the environment variable PARITY_SHARED, else below
/// the folder `shared` beside the source tree. None where it is not there: the test is then skipped
/// with `GTEST_SKIP() << "skipped: no shared data"`.
///
/// @param relative  e.g. "data/mesh/spot.obj".
inline std::optional<std::filesystem::path> shared_data(const std::string& relative) {
  const char* root = std::getenv("PARITY_SHARED");
  const std::filesystem::path folder =
      root != nullptr ? std::filesystem::path(root)
                      : std::filesystem::path(PARITY_SOURCE_DIR) / ".." / "shared";
  const std::filesystem::path path = folder / relative;
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return std::nullopt;
  return path;
}

}  // namespace parity
