#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace parity::gltf {

/// The parts of a .gltf or .glb file. The spans point into the file's bytes.
struct Container {
  std::string_view json;
  std::optional<std::span<const std::byte>> binary;  ///< BIN chunk of a GLB
  std::size_t trailing = 0;                          ///< bytes of the file after the end of the GLB
};

/// Tells GLB from JSON by the magic number and cuts it into its chunks.
///
/// @throws InputError  a header or chunk that does not fit the file.
///
/// Source: glTF 2.0, "GLB File Format Specification".
Container open_container(std::span<const std::byte> bytes, const std::string& name);

/// Looks at JSON text before anybody builds values from it: well-formed UTF-8, one object and
/// nothing after it, nested at most 512 deep, no key twice in one object, no number beyond double.
///
/// @throws InputError  with the byte at which the text goes wrong.
void check_json_text(std::string_view text, const std::string& name);

}  // namespace parity::gltf
