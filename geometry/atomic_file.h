#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace parity {

/// Writes a file that appears whole or not at all: a temporary name in the same folder, then a
/// rename. A failure removes the temporary. A link is followed; a device or a pipe is written to
/// as it is.
///
/// @throws OutputError  the file cannot be written; what stood there before still does.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_file_atomically(const std::filesystem::path& path, std::string_view text);

/// The bytes of a file or a pipe.
///
/// @param max_bytes  more than that is refused before it is held.
/// @throws InputError  missing, unreadable, a folder, a device, or larger than max_bytes.
std::vector<std::byte> read_file(const std::filesystem::path& path, std::size_t max_bytes);

}  // namespace parity
