#include "geometry/mesh_io.h"

#include <algorithm>
#include <stdexcept>
#include <system_error>

#include "geometry/atomic_file.h"
#include "geometry/input_error.h"
#include "geometry/mesh_formats.h"

namespace parity {
namespace {

constexpr std::size_t max_mesh_bytes = 0xffffffff;  // so that corners are counted by 32 bits
constexpr std::size_t max_material_bytes = 1u << 24;

std::string ending_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
  return ending;
}

/// The place of a file that an asset names: in the asset's folder or below it, links followed.
/// Empty: it is not there, or elsewhere.
std::filesystem::path inside_folder(const std::filesystem::path& asset, const std::string& name) {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::canonical(
      asset.has_parent_path() ? asset.parent_path() : std::filesystem::path("."), error);
  if (error || name.find('\0') != std::string::npos) return {};
  const std::filesystem::path file = std::filesystem::canonical(folder / name, error);
  if (error || !std::filesystem::is_regular_file(file, error)) return {};
  const auto [in_folder, in_file] =
      std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return in_folder == folder.end() ? file : std::filesystem::path{};
}

void read_materials(Mesh& mesh, const std::vector<std::string>& files,
                    const std::filesystem::path& asset) {
  for (const std::string& name : files) {
    const std::filesystem::path file = inside_folder(asset, name);
    if (file.empty())
      mesh.notes.push_back("the material file " + detail::quoted(name) +
                           " is not in the folder of the mesh.");
    else
      detail::apply_mtl(mesh, read_file(file, max_material_bytes), file.string());
  }
}

void note_materials(Mesh& mesh, const std::vector<std::string>& files) {
  for (const std::string& name : files)
    mesh.notes.push_back("the material file " + detail::quoted(name) + " was not opened.");
}

}  // namespace

Mesh decode_mesh(std::span<const std::byte> bytes, const std::string& name) {
  const std::string ending = ending_of(name);
  if (ending == ".obj") {
    detail::ObjFile file = detail::decode_obj(bytes, name);
    note_materials(file.mesh, file.material_files);
    return std::move(file.mesh);
  }
  if (ending == ".ply") return detail::decode_ply(bytes, name);
  if (ending == ".stl") return detail::decode_stl(bytes, name);
  if (ending == ".off") return detail::decode_off(bytes, name);
  throw InputError(name, "is not known as a mesh; expected .obj, .ply, .stl or .off");
}

Mesh load_mesh(const std::filesystem::path& path) {
  if (ending_of(path) != ".obj") return decode_mesh(read_file(path, max_mesh_bytes), path.string());
  detail::ObjFile file = detail::decode_obj(read_file(path, max_mesh_bytes), path.string());
  read_materials(file.mesh, file.material_files, path);
  return std::move(file.mesh);
}

void save_mesh(const std::filesystem::path& path, const Mesh& mesh) {
  const std::string ending = ending_of(path);
  if (ending == ".obj")
    write_file_atomically(path, detail::encode_obj(mesh));
  else if (ending == ".ply")
    write_file_atomically(path, detail::encode_ply(mesh));
  else if (ending == ".stl")
    write_file_atomically(path, detail::encode_stl(mesh));
  else if (ending == ".off")
    write_file_atomically(path, detail::encode_off(mesh));
  else
    throw std::invalid_argument("save_mesh: '" + path.string() +
                                "' ends in none of .obj, .ply, .stl, .off");
}

}  // namespace parity
