#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <unordered_map>

#include "geometry/input_error.h"
#include "geometry/mesh_formats.h"

namespace parity::detail {
namespace {

constexpr std::int64_t max_index = 0xffffffff;

/// The three lists that a corner's indices point into.
enum ListKind { position_list, uv_list, normal_list };
constexpr const char* list_names[] = {"vertex", "texture coordinate", "normal"};

class ObjReader {
 public:
  ObjReader(Bytes bytes, const std::string& name) : lines_(text_of(bytes), name), name_(name) {}

  ObjFile read() {
    for (std::string_view line; next_line(line);) read_statement(line);
    if (face_statements_ == 0)
      throw InputError(name_, "has no faces (" + std::to_string(positions().size()) + " vertices)");
    check_ranges();
    fill_corners();
    note_dropped_faces(mesh_, dropped_faces_);
    for (const std::string& keyword : ignored_)
      mesh_.notes.push_back("'" + keyword + "' statements were left out.");
    return std::move(file_);
  }

 private:
  /// A line with those that a backslash at its end continues it with.
  bool next_line(std::string_view& line) {
    if (!lines_.next(line)) return false;
    if (!line.ends_with('\\')) return true;
    joined_.clear();
    do {
      joined_.append(line.substr(0, line.size() - line.ends_with('\\')));
      joined_ += ' ';
    } while (line.ends_with('\\') && lines_.next(line));
    line = joined_;
    return true;
  }

  void read_statement(std::string_view line) {
    const std::string_view keyword = take_word(line);
    if (keyword.empty() || keyword.starts_with('#')) return;
    if (keyword == "v")
      read_vertex(line);
    else if (keyword == "vt")
      read_uv(line);
    else if (keyword == "vn")
      normals_.push_back(normalized_or_zero(parse_vec3(line, lines_)));
    else if (keyword == "f" || keyword == "fo")
      read_face(line);
    else if (keyword == "usemtl")
      use_material(std::string(trimmed(line)));
    else if (keyword == "mtllib")
      file_.material_files.emplace_back(trimmed(line));
    else if (keyword != "o" && keyword != "g" && keyword != "s" && ignored_.size() < 16)
      ignored_.insert(std::string(keyword.substr(0, 40)));
  }

  /// x y z, then nothing, a weight, or a colour.
  void read_vertex(std::string_view line) {
    positions().push_back(parse_vec3(line, lines_));
    vec3 color{1.0f};
    int count = 0;
    for (std::string_view word = take_word(line); !word.empty() && !word.starts_with('#');
         word = take_word(line), ++count)
      if (count < 3) color[count] = parse_float(word, lines_);
    if (count >= 3) {
      mesh_.vertex_colors.resize(positions().size() - 1, vec3(1.0f));
      mesh_.vertex_colors.push_back(color);
    }
  }

  void read_uv(std::string_view line) {
    const float u = parse_float(take_word(line), lines_);
    const std::string_view word = take_word(line);
    uvs_.push_back({u, word.empty() ? 0.0f : parse_float(word, lines_)});
  }

  void read_face(std::string_view line) {
    ++face_statements_;
    for (std::string_view word = take_word(line); !word.empty() && !word.starts_with('#');
         word = take_word(line))
      read_corner(word);
    if (end_face(mesh_)) {
      mesh_.face_materials.push_back(material_);
    } else {
      ++dropped_faces_;
      corner_uv_.resize(mesh_.corners.size());
      corner_normal_.resize(mesh_.corners.size());
    }
  }

  /// v, v/t, v//n or v/t/n; a part may be empty.
  void read_corner(std::string_view word) {
    std::uint32_t index[3] = {0, 0, 0};
    std::string_view rest = word;
    for (int list = 0; list < 3; ++list) {
      const std::size_t end = std::min(rest.find('/'), rest.size());
      const std::string_view part = rest.substr(0, end);
      if (!part.empty()) index[list] = read_index(part, ListKind(list));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    if (index[0] == 0 || !rest.empty())
      lines_.refuse("corner " + quoted(word) + ", expected v/t/n");
    mesh_.corners.push_back(index[0] - 1);
    corner_uv_.push_back(index[1]);
    corner_normal_.push_back(index[2]);
  }

  std::size_t count_of(ListKind list) const {
    return list == position_list ? mesh_.positions.size()
           : list == uv_list     ? uvs_.size()
                                 : normals_.size();
  }

  /// Counted from 1. An absolute index may point ahead: its range is checked at the end.
  std::uint32_t read_index(std::string_view word, ListKind list) {
    const auto count = std::int64_t(count_of(list));
    std::int64_t index = parse_integer(word, lines_);
    if (index < 0) index += count + 1;
    if (index < 1 || index > max_index)
      lines_.refuse(std::string(list_names[list]) + " index " + quoted(word) + ", expected 1 to " +
                    std::to_string(count) + " or -" + std::to_string(count) + " to -1");
    if (index > largest_[list].index) largest_[list] = {index, lines_.number()};
    return std::uint32_t(index);
  }

  void check_ranges() const {
    for (ListKind list : {position_list, uv_list, normal_list})
      if (largest_[list].index > std::int64_t(count_of(list)))
        throw InputError(name_, largest_[list].line,
                         std::string(list_names[list]) + " index " +
                             std::to_string(largest_[list].index) + ", but the file has " +
                             std::to_string(count_of(list)));
  }

  void use_material(const std::string& material) {
    const auto [entry, is_new] =
        material_of_name_.try_emplace(material, int(mesh_.materials.size()));
    if (is_new) {
      mesh_.materials.emplace_back();
      mesh_.materials.back().name = material;
    }
    material_ = entry->second;
  }

  /// Follows the indices of texture coordinates and normals, now that all of them are there.
  void fill_corners() {
    if (!mesh_.vertex_colors.empty()) mesh_.vertex_colors.resize(positions().size(), vec3(1.0f));
    if (mesh_.materials.empty()) mesh_.face_materials.clear();
    const auto is_used = [](std::uint32_t index) { return index != 0; };
    if (std::any_of(corner_uv_.begin(), corner_uv_.end(), is_used))
      for (std::uint32_t i : corner_uv_) mesh_.corner_uvs.push_back(i ? uvs_[i - 1] : vec2(0.0f));
    if (std::any_of(corner_normal_.begin(), corner_normal_.end(), is_used))
      for (std::uint32_t i : corner_normal_)
        mesh_.corner_normals.push_back(i ? normals_[i - 1] : vec3(0.0f));
  }

  std::vector<vec3>& positions() { return mesh_.positions; }

  struct Largest {
    std::int64_t index = 0;
    std::size_t line = 0;
  };

  LineReader lines_;
  std::string name_;
  std::string joined_;
  ObjFile file_;
  Mesh& mesh_ = file_.mesh;
  std::vector<vec2> uvs_;
  std::vector<vec3> normals_;
  std::vector<std::uint32_t> corner_uv_;      ///< from 1; 0: none
  std::vector<std::uint32_t> corner_normal_;  ///< from 1; 0: none
  Largest largest_[3];
  int material_ = -1;
  std::unordered_map<std::string, int> material_of_name_;
  std::set<std::string> ignored_;
  std::size_t face_statements_ = 0;
  std::size_t dropped_faces_ = 0;
};

void append_corner(std::string& text, const Mesh& mesh, std::size_t corner) {
  const auto out = std::back_inserter(text);
  const std::size_t attribute = corner + 1;
  fmt::format_to(out, " {}", mesh.corners[corner] + 1);
  if (mesh.corner_uvs.empty() && mesh.corner_normals.empty()) return;
  text += '/';
  if (!mesh.corner_uvs.empty()) fmt::format_to(out, "{}", attribute);
  if (!mesh.corner_normals.empty()) fmt::format_to(out, "/{}", attribute);
}

}  // namespace

ObjFile decode_obj(Bytes bytes, const std::string& name) { return ObjReader(bytes, name).read(); }

std::string encode_obj(const Mesh& mesh) {
  std::string text;
  const auto out = std::back_inserter(text);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const vec3& p = mesh.positions[v];
    fmt::format_to(out, "v {} {} {}", p.x, p.y, p.z);
    if (!mesh.vertex_colors.empty()) {
      const vec3& c = mesh.vertex_colors[v];
      fmt::format_to(out, " {} {} {}", c.x, c.y, c.z);
    }
    text += '\n';
  }
  for (const vec2& uv : mesh.corner_uvs) fmt::format_to(out, "vt {} {}\n", uv.x, uv.y);
  for (const vec3& n : mesh.corner_normals) fmt::format_to(out, "vn {} {} {}\n", n.x, n.y, n.z);
  for (std::size_t face = 0; face < mesh.face_count(); ++face) {
    text += 'f';
    for (std::size_t c = mesh.face_begin[face]; c < mesh.face_begin[face + 1]; ++c)
      append_corner(text, mesh, c);
    text += '\n';
  }
  return text;
}

}  // namespace parity::detail
