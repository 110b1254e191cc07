#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "geometry/gltf_document.h"
#include "geometry/gltf_files.h"

namespace parity::gltf {

/// EXT_meshopt_compression: the bytes of the view, stride x count of them.
///
/// @throws InputError  at `place`: the stream is damaged, or too short for what it claims to hold.
Bytes decode_meshopt(const CompressedView& view, std::span<const std::byte> bytes,
                     const std::string& name, const std::string& place);

/// A primitive out of KHR_draco_mesh_compression.
struct DracoMesh {
  std::uint32_t vertex_count = 0;
  std::vector<std::uint32_t> indices;
  std::map<std::string, std::vector<float>> attributes;  ///< by semantic, element after element
};

/// @param attributes  semantic to unique id in the stream.
/// @param components  semantic to the number of components that is wanted.
/// @throws InputError  at `place`.
DracoMesh decode_draco(const Attributes& attributes, const std::map<std::string, int>& components,
                       std::span<const std::byte> bytes, const std::string& name,
                       const std::string& place);

}  // namespace parity::gltf
