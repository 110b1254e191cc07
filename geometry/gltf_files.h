#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace parity::gltf {

using Bytes = std::vector<std::byte>;

/// Where an asset came from: its name in messages, and the folder that its URIs may not leave. No
/// folder: nothing is opened.
struct Origin {
  std::string name;
  std::optional<std::filesystem::path> folder;
};

/// A whole regular file, whatever it claims to be.
///
/// @param most  bytes at most; a longer file is refused.
/// @throws InputError  missing, unreadable, a folder or device, or too large.
Bytes read_file(const std::filesystem::path& file, std::uint64_t most);

bool is_data_uri(std::string_view uri);

/// Looks at a URI that is not going to be read: as read_uri, without touching the file system.
///
/// @throws InputError  not base64; empty, absolute, with a scheme, or out of the folder.
void check_uri(const std::string& uri, const Origin& origin, const std::string& place);

/// The bytes that a URI names: data inside it, or a regular file inside the origin's folder.
///
/// @param place  JSON path of the URI for messages.
/// @param most   bytes at most that are read; the rest of a longer file is left.
/// @throws InputError  not base64; absolute, with a scheme, or outside the folder; not a file.
Bytes read_uri(const std::string& uri, const Origin& origin, const std::string& place,
               std::uint64_t most);

}  // namespace parity::gltf
