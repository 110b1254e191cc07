#pragma once

#include <string>
#include <string_view>

#include "geometry/gltf_document.h"

namespace tinygltf {
struct Material;
}

namespace parity::gltf {

/// JSON to plain values: the guard, the schema, then tinygltf, which sees only JSON that has passed
/// both, and neither buffers nor images nor the file system.
///
/// @throws InputError
Document parse_document(std::string_view json, const std::string& name);

/// @throws InputError  naming materials[index].
Material convert_material(const tinygltf::Material& from);

}  // namespace parity::gltf
