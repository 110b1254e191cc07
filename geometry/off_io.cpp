#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "geometry/color.h"
#include "geometry/input_error.h"
#include "geometry/mesh_formats.h"

namespace parity::detail {
namespace {

class OffReader {
 public:
  OffReader(Bytes bytes, const std::string& name) : lines_(text_of(bytes), name), name_(name) {}

  Mesh read() {
    read_header();
    for (std::int64_t v = 0; v < vertex_count_; ++v) read_vertex();
    std::size_t dropped = 0;
    for (std::int64_t f = 0; f < face_count_; ++f) dropped += read_face() ? 0 : 1;
    check_corners(mesh_, name_);
    for (std::uint32_t vertex : mesh_.corners) {
      if (!uvs_.empty()) mesh_.corner_uvs.push_back(uvs_[vertex]);
      if (!normals_.empty()) mesh_.corner_normals.push_back(normals_[vertex]);
    }
    note_dropped_faces(mesh_, dropped);
    return std::move(mesh_);
  }

 private:
  /// The next line with something on it, without its comment.
  std::string_view next_line(const char* expected) {
    std::string_view line;
    while (lines_.next(line)) {
      line = line.substr(0, line.find('#'));
      std::string_view copy = line;
      if (!take_word(copy).empty()) return line;
    }
    throw InputError(name_, lines_.number(), std::string("the file ends, expected ") + expected);
  }

  void read_header() {
    std::string_view line = next_line("OFF");
    std::string_view magic = take_word(line);
    const std::string_view whole = magic;
    has_uvs_ = magic.starts_with("ST");
    if (has_uvs_) magic.remove_prefix(2);
    has_colors_ = magic.starts_with('C');
    if (has_colors_) magic.remove_prefix(1);
    has_normals_ = magic.starts_with('N');
    if (has_normals_) magic.remove_prefix(1);
    if (magic != "OFF") lines_.refuse(quoted(whole) + ", expected OFF, COFF, NOFF or STOFF");
    std::string_view counts = line;
    if (std::string_view copy = line; take_word(copy).empty()) counts = next_line("the counts");
    vertex_count_ = parse_count(take_word(counts));
    face_count_ = parse_count(take_word(counts));
    if (face_count_ == 0) lines_.refuse("has no faces");
  }

  /// An element takes two bytes at least.
  std::int64_t parse_count(std::string_view word) const {
    const std::int64_t count = parse_integer(word, lines_);
    if (count < 0 || count > std::int64_t(lines_.rest().size() / 2 + 1))
      lines_.refuse("count " + quoted(word) + ", more than the file can hold");
    return count;
  }

  void read_vertex() {
    std::string_view line = next_line("a vertex");
    mesh_.positions.push_back(parse_vec3(line, lines_));
    if (has_normals_) normals_.push_back(normalized_or_zero(parse_vec3(line, lines_)));
    if (has_colors_) mesh_.vertex_colors.push_back(read_color(line));
    if (has_uvs_) {
      const float u = parse_float(take_word(line), lines_);
      uvs_.push_back({u, parse_float(take_word(line), lines_)});
    }
  }

  /// Red, green, blue and perhaps alpha: whole numbers to 255 in sRGB, or real numbers, linear.
  vec3 read_color(std::string_view& line) {
    vec3 color;
    bool is_whole = true;
    for (int c = 0; c < 3; ++c) {
      const std::string_view word = take_word(line);
      is_whole = is_whole && word.find_first_of(".eE") == std::string_view::npos;
      color[c] = parse_float(word, lines_);
    }
    std::string_view ahead = line;
    take_word(ahead);
    if (!has_uvs_ || words_in(line) > 2) line = ahead;
    if (!is_whole) return color;
    for (int c = 0; c < 3; ++c)
      color[c] = linear_from_srgb(std::clamp(color[c] / 255.0f, 0.0f, 1.0f));
    return color;
  }

  static int words_in(std::string_view line) {
    int count = 0;
    while (!take_word(line).empty()) ++count;
    return count;
  }

  /// n v1 ... vn, and perhaps a colour, which is left out.
  bool read_face() {
    std::string_view line = next_line("a face");
    const std::int64_t count = parse_integer(take_word(line), lines_);
    if (count < 0) lines_.refuse("a face with " + std::to_string(count) + " corners");
    for (std::int64_t i = 0; i < count; ++i) {
      const std::string_view word = take_word(line);
      const std::int64_t vertex = parse_integer(word, lines_);
      if (vertex < 0 || vertex >= vertex_count_)
        lines_.refuse("vertex " + quoted(word) + ", expected 0 to " +
                      std::to_string(vertex_count_ - 1));
      mesh_.corners.push_back(std::uint32_t(vertex));
    }
    return end_face(mesh_);
  }

  LineReader lines_;
  std::string name_;
  Mesh mesh_;
  bool has_uvs_ = false;
  bool has_colors_ = false;
  bool has_normals_ = false;
  std::int64_t vertex_count_ = 0;
  std::int64_t face_count_ = 0;
  std::vector<vec2> uvs_;
  std::vector<vec3> normals_;
};

}  // namespace

Mesh decode_off(Bytes bytes, const std::string& name) { return OffReader(bytes, name).read(); }

std::string encode_off(const Mesh& mesh) {
  std::string text = fmt::format("OFF\n{} {} 0\n", mesh.vertex_count(), mesh.face_count());
  const auto out = std::back_inserter(text);
  for (const vec3& p : mesh.positions) fmt::format_to(out, "{} {} {}\n", p.x, p.y, p.z);
  for (std::size_t face = 0; face < mesh.face_count(); ++face) {
    fmt::format_to(out, "{}", mesh.face_begin[face + 1] - mesh.face_begin[face]);
    for (std::size_t c = mesh.face_begin[face]; c < mesh.face_begin[face + 1]; ++c)
      fmt::format_to(out, " {}", mesh.corners[c]);
    text += '\n';
  }
  return text;
}

}  // namespace parity::detail
