#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "geometry/scene.h"

/// Scenes out of files.
namespace parity {

/// Loads glTF 2.0 (.gltf with its files beside it, .glb), checked completely, in the pose that the
/// file starts with; or a mesh (.obj, .ply, .stl, .off) as a scene of one node, see
/// scene_from_mesh.
///
/// Read: the core specification and EXT_mesh_gpu_instancing, EXT_meshopt_compression,
/// KHR_draco_mesh_compression, KHR_lights_punctual, KHR_materials_emissive_strength,
/// KHR_materials_pbrSpecularGlossiness (as the nearest metallic-roughness), KHR_materials_unlit,
/// KHR_materials_variants (the default), KHR_mesh_quantization, KHR_texture_transform; images as
/// PNG and JPEG. Another extension is refused by name if the file requires it, else noted and
/// ignored.
///
/// Nothing outside the file's folder is opened. Geometry takes at most 128 MiB + 64 times the size
/// of the input, images at most 512 MiB + 128 times the size of their files.
///
/// @throws InputError  missing, malformed or unsupported: file, JSON path, value, expectation.
///
/// Source: glTF 2.0 specification, sections 3 and 4.
Scene load_scene(const std::filesystem::path& file);

/// The same from the bytes of a .gltf or .glb that names no other files.
///
/// @param name  stands for the file in messages.
Scene load_scene_from_memory(std::span<const std::byte> bytes, const std::string& name);

}  // namespace parity
