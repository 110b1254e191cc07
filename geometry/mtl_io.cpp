#include <algorithm>

#include "geometry/mesh_formats.h"

namespace parity::detail {
namespace {

/// The file of a map statement: its last word; options and their values stand before it.
std::string map_file(std::string_view line) {
  std::string_view last;
  for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) last = word;
  return std::string(last);
}

void read_property(MeshMaterial& material, std::string_view keyword, std::string_view line,
                   const LineReader& lines) {
  const auto number = [&] { return parse_float(take_word(line), lines); };
  if (keyword == "Kd")
    material.diffuse = parse_vec3(line, lines);
  else if (keyword == "Ks")
    material.specular = parse_vec3(line, lines);
  else if (keyword == "Ke")
    material.emission = parse_vec3(line, lines);
  else if (keyword == "Ns")
    material.shininess = number();
  else if (keyword == "d")
    material.opacity = std::clamp(number(), 0.0f, 1.0f);
  else if (keyword == "Tr")
    material.opacity = std::clamp(1.0f - number(), 0.0f, 1.0f);
  else if (keyword == "Pr")
    material.roughness = std::clamp(number(), 0.0f, 1.0f);
  else if (keyword == "Pm")
    material.metallic = std::clamp(number(), 0.0f, 1.0f);
  else if (keyword == "map_Kd")
    material.diffuse_map = map_file(line);
}

bool is_color_by_other_means(std::string_view line) {
  const std::string_view word = take_word(line);
  return word == "spectral" || word == "xyz" || word == "-halo";
}

}  // namespace

void apply_mtl(Mesh& mesh, Bytes bytes, const std::string& name) {
  LineReader lines{text_of(bytes), name};
  MeshMaterial* material = nullptr;
  for (std::string_view line; lines.next(line);) {
    const std::string_view keyword = take_word(line);
    if (keyword == "newmtl") {
      const std::string_view wanted = trimmed(line);
      const auto found =
          std::find_if(mesh.materials.begin(), mesh.materials.end(),
                       [&](const MeshMaterial& known) { return known.name == wanted; });
      material = found == mesh.materials.end() ? nullptr : &*found;
    } else if (material != nullptr && !is_color_by_other_means(line)) {
      read_property(*material, keyword, line, lines);
    }
  }
}

}  // namespace parity::detail
