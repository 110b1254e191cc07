#include "geometry/scene_io.h"

#include <algorithm>
#include <cctype>

#include "geometry/gltf_convert.h"
#include "geometry/gltf_guard.h"
#include "geometry/gltf_parse.h"
#include "geometry/input_error.h"
#include "geometry/mesh_io.h"
#include "geometry/scene_from_mesh.h"

namespace parity {
namespace {

constexpr std::uint64_t largest_file = std::uint64_t(1) << 32;

Scene load_gltf(std::span<const std::byte> bytes, const gltf::Origin& origin) {
  const gltf::Container container = gltf::open_container(bytes, origin.name);
  gltf::Document document = gltf::parse_document(container.json, origin.name);
  if (container.trailing > 0)
    document.notes.push_back("bytes after the end of the GLB ignored: " +
                             std::to_string(container.trailing));
  gltf::link_nodes(document, origin.name);
  gltf::check_document(document, origin.name);
  const gltf::Data data(document, container.binary, origin);
  gltf::check_animations(document, data, origin.name);
  return gltf::convert_document(document, data, origin);
}

std::string ending_of(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = char(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

}  // namespace

Scene load_scene(const std::filesystem::path& file) {
  const std::string ending = ending_of(file);
  if (ending == ".obj" || ending == ".ply" || ending == ".stl" || ending == ".off")
    return scene_from_mesh(load_mesh(file), file.string(), file.parent_path());
  if (ending != ".gltf" && ending != ".glb")
    throw InputError(file.string(), "the name must end in .gltf, .glb, .obj, .ply, .stl or .off");
  const gltf::Bytes bytes = gltf::read_file(file, largest_file);
  return load_gltf(bytes, {.name = file.string(), .folder = file.parent_path()});
}

Scene load_scene_from_memory(std::span<const std::byte> bytes, const std::string& name) {
  return load_gltf(bytes, {.name = name, .folder = std::nullopt});
}

}  // namespace parity
