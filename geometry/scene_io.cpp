#include "geometry/scene_io.h"

#include "geometry/gltf_convert.h"
#include "geometry/gltf_guard.h"
#include "geometry/gltf_parse.h"
#include "geometry/input_error.h"

namespace parity {
namespace {

constexpr std::uint64_t largest_file = std::uint64_t(1) << 32;

Scene load_gltf(std::span<const std::byte> bytes, const gltf::Origin& origin) {
  const gltf::Container container = gltf::open_container(bytes, origin.name);
  gltf::Document document = gltf::parse_document(container.json, origin.name);
  gltf::link_nodes(document, origin.name);
  gltf::check_document(document, origin.name);
  const gltf::Data data(document, container.binary, origin);
  gltf::check_animations(document, data, origin.name);
  return gltf::convert_document(document, data, origin);
}

}  // namespace

Scene load_scene(const std::filesystem::path& file) {
  const gltf::Bytes bytes = gltf::read_file(file, largest_file);
  return load_gltf(bytes, {.name = file.string(), .folder = file.parent_path()});
}

Scene load_scene_from_memory(std::span<const std::byte> bytes, const std::string& name) {
  return load_gltf(bytes, {.name = name, .folder = std::nullopt});
}

}  // namespace parity
