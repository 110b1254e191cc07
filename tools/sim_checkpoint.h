#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace parity::tools {

/// A run between two steps: from it the run goes on as if it had never stopped.
struct Checkpoint {
  std::string physics;       ///< physics_text of the scene
  std::string backend;       ///< "gpu" or "cpu"
  std::uint64_t steps = 0;   ///< since the beginning
  std::uint32_t frames = 0;  ///< written so far
  double seconds = 0;        ///< that all parts of the run took
  std::string history;       ///< a JSON array with the measures of those frames
  std::string state;         ///< what Simulation::save gave

  bool operator==(const Checkpoint&) const = default;
};

/// Magic number, version, byte order, length, checksum, contents.
std::string encode_checkpoint(const Checkpoint& checkpoint);

/// @throws InputError  not a checkpoint, of another version or byte order, cut short, too long, or
///                     damaged.
Checkpoint decode_checkpoint(std::string_view bytes, const std::string& name);

/// Appears whole or not at all; the one before stays if the disk is full.
///
/// @throws OutputError
void save_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);

/// @throws InputError  as decode_checkpoint; missing; made by another scene or backend (the message
///                     names the first key that differs).
Checkpoint load_checkpoint(const std::filesystem::path& path, const std::string& physics,
                           const std::string& backend);

/// FNV-1a of 64 bits. Source: Fowler, Noll & Vo.
std::uint64_t checksum(std::string_view bytes);

}  // namespace parity::tools
