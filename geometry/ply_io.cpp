#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>

#include "geometry/color.h"
#include "geometry/input_error.h"
#include "geometry/mesh_formats.h"

namespace parity::detail {
namespace {

enum class Scalar { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class Encoding { ascii, little_endian, big_endian };

constexpr std::size_t scalar_bytes[] = {1, 1, 2, 2, 4, 4, 4, 8};
constexpr const char* scalar_names[][2] = {
    {"char", "int8"}, {"uchar", "uint8"}, {"short", "int16"},   {"ushort", "uint16"},
    {"int", "int32"}, {"uint", "uint32"}, {"float", "float32"}, {"double", "float64"}};

bool is_whole(Scalar type) { return type < Scalar::float32; }

struct Property {
  std::string name;
  Scalar type = Scalar::float32;
  std::optional<Scalar> count_type;  ///< there: a list
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;
};

/// What a vertex property is; the order of `vertex_property_names`.
enum Slot {
  slot_x,
  slot_y,
  slot_z,
  slot_nx,
  slot_ny,
  slot_nz,
  slot_r,
  slot_g,
  slot_b,
  slot_u,
  slot_v
};
constexpr std::size_t slot_count = 11;
constexpr std::array<std::array<const char*, 4>, slot_count> vertex_property_names = {{
    {"x"},
    {"y"},
    {"z"},
    {"nx"},
    {"ny"},
    {"nz"},
    {"red", "r", "diffuse_red"},
    {"green", "g", "diffuse_green"},
    {"blue", "b", "diffuse_blue"},
    {"u", "s", "texture_u", "texture_s"},
    {"v", "t", "texture_v", "texture_t"},
}};

std::optional<std::size_t> slot_of(const std::string& name) {
  for (std::size_t slot = 0; slot < slot_count; ++slot)
    for (const char* known : vertex_property_names[slot])
      if (known != nullptr && name == known) return slot;
  return std::nullopt;
}

class PlyReader {
 public:
  PlyReader(Bytes bytes, const std::string& name) : lines_(text_of(bytes), name), name_(name) {}

  Mesh read() {
    read_header();
    body_ = lines_.rest();
    for (const Element& element : elements_) {
      check_room(element);
      if (element.name == "vertex")
        read_vertices(element);
      else if (element.name == "face")
        read_faces(element);
      else
        for (std::int64_t i = 0; i < element.count && !element.properties.empty(); ++i)
          for (const Property& property : element.properties) skip(property);
    }
    if (!has_faces_) throw InputError(name_, "has no faces");
    check_corners(mesh_, name_);
    for (std::uint32_t vertex : mesh_.corners) {
      if (!uvs_.empty()) mesh_.corner_uvs.push_back(uvs_[vertex]);
      if (!normals_.empty()) mesh_.corner_normals.push_back(normals_[vertex]);
    }
    note_dropped_faces(mesh_, dropped_faces_);
    return std::move(mesh_);
  }

 private:
  void read_header() {
    std::string_view line;
    if (!lines_.next(line) || take_word(line) != "ply") lines_.refuse("expected 'ply'");
    while (lines_.next(line)) {
      const std::string_view keyword = take_word(line);
      if (keyword == "end_header") return;
      if (keyword == "format")
        read_format(take_word(line));
      else if (keyword == "element")
        read_element(line);
      else if (keyword == "property")
        read_property(line);
      else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty())
        lines_.refuse(quoted(keyword) + ", expected format, element, property or end_header");
    }
    lines_.refuse("the file ends inside its header");
  }

  void read_format(std::string_view word) {
    if (word == "ascii")
      encoding_ = Encoding::ascii;
    else if (word == "binary_little_endian")
      encoding_ = Encoding::little_endian;
    else if (word == "binary_big_endian")
      encoding_ = Encoding::big_endian;
    else
      lines_.refuse("format " + quoted(word) + ", expected ascii or binary of either byte order");
  }

  void read_element(std::string_view line) {
    Element element;
    element.name = take_word(line);
    element.count = parse_integer(take_word(line), lines_);
    if (element.count < 0) lines_.refuse("an element with a count below 0");
    elements_.push_back(std::move(element));
  }

  void read_property(std::string_view line) {
    if (elements_.empty()) lines_.refuse("a property before the first element");
    Property property;
    std::string_view word = take_word(line);
    if (word == "list") {
      property.count_type = parse_type(take_word(line));
      if (!is_whole(*property.count_type)) lines_.refuse("a list that is counted by real numbers");
      word = take_word(line);
    }
    property.type = parse_type(word);
    property.name = take_word(line);
    elements_.back().properties.push_back(std::move(property));
  }

  Scalar parse_type(std::string_view word) const {
    for (std::size_t i = 0; i < std::size(scalar_names); ++i)
      if (word == scalar_names[i][0] || word == scalar_names[i][1]) return Scalar(i);
    lines_.refuse("type " + quoted(word) + ", expected one of PLY's");
  }

  /// A property takes at least its bytes, or in text a digit and a blank; a list at least its
  /// count.
  void check_room(const Element& element) const {
    std::size_t least = 0;
    for (const Property& property : element.properties)
      least += encoding_ == Encoding::ascii
                   ? 2
                   : scalar_bytes[std::size_t(property.count_type.value_or(property.type))];
    const std::size_t room = least == 0 ? 0 : (body_.size() + 1) / least;
    if (least > 0 && std::uint64_t(element.count) > room)
      throw InputError(name_, "the header claims " + std::to_string(element.count) + " elements '" +
                                  element.name.substr(0, 40) + "', but the file has room for " +
                                  std::to_string(room));
  }

  [[noreturn]] void refuse_end() const { throw InputError(name_, "the file ends too early"); }

  double read_number(Scalar type) {
    return encoding_ == Encoding::ascii ? read_word(type) : read_binary(type);
  }

  double read_word(Scalar type) {
    std::string_view word = take_word(line_);
    while (word.empty()) {
      if (!lines_.next(line_)) refuse_end();
      body_ = lines_.rest();
      word = take_word(line_);
    }
    if (is_whole(type)) return double(parse_integer(word, lines_));
    return double(parse_float(word, lines_));
  }

  double read_binary(Scalar type) {
    const std::size_t size = scalar_bytes[std::size_t(type)];
    if (body_.size() < size) refuse_end();
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t place = encoding_ == Encoding::little_endian ? i : size - 1 - i;
      bits |= std::uint64_t(std::uint8_t(body_[i])) << (8 * place);
    }
    body_.remove_prefix(size);
    switch (type) {
      case Scalar::int8:
        return double(std::int8_t(bits));
      case Scalar::int16:
        return double(std::int16_t(bits));
      case Scalar::int32:
        return double(std::int32_t(bits));
      case Scalar::float32:
        return double(std::bit_cast<float>(std::uint32_t(bits)));
      case Scalar::float64:
        return std::bit_cast<double>(bits);
      default:
        return double(bits);
    }
  }

  std::int64_t read_list_size(const Property& property) {
    const auto size = std::int64_t(read_number(*property.count_type));
    if (size < 0) throw InputError(name_, "a list '" + property.name + "' with a count below 0");
    return size;
  }

  void skip(const Property& property) {
    const std::int64_t count = property.count_type ? read_list_size(property) : 1;
    for (std::int64_t i = 0; i < count; ++i) read_number(property.type);
  }

  void read_vertices(const Element& element) {
    std::vector<std::optional<std::size_t>> slots;
    std::array<bool, slot_count> has{};
    bool has_whole_colors = false;
    for (const Property& property : element.properties) {
      slots.push_back(property.count_type ? std::nullopt : slot_of(property.name));
      if (!slots.back()) continue;
      has[*slots.back()] = true;
      if (*slots.back() == slot_r) has_whole_colors = is_whole(property.type);
    }
    if (!has[slot_x] || !has[slot_y] || !has[slot_z])
      throw InputError(name_, "its vertices lack x, y or z");
    for (std::int64_t i = 0; i < element.count; ++i) {
      std::array<double, slot_count> values{};
      for (std::size_t p = 0; p < slots.size(); ++p)
        if (slots[p])
          values[*slots[p]] = read_number(element.properties[p].type);
        else
          skip(element.properties[p]);
      add_vertex(values, has, has_whole_colors);
    }
  }

  void add_vertex(const std::array<double, slot_count>& values,
                  const std::array<bool, slot_count>& has, bool has_whole_colors) {
    const auto three = [&](std::size_t first) {
      return vec3(float(values[first]), float(values[first + 1]), float(values[first + 2]));
    };
    const vec3 p = three(slot_x);
    for (int i = 0; i < 3; ++i)
      if (!std::isfinite(p[i]))
        throw InputError(name_, "vertex " + std::to_string(mesh_.positions.size()) +
                                    " (from 0) is not finite in single precision");
    mesh_.positions.push_back(p);
    if (has[slot_nx] && has[slot_ny] && has[slot_nz]) {
      const vec3 n = normalized_or_zero(three(slot_nx));
      normals_.push_back(std::isfinite(n.x + n.y + n.z) ? n : vec3(0.0f));
    }
    if (has[slot_r] && has[slot_g] && has[slot_b])
      mesh_.vertex_colors.push_back(color_of(three(slot_r), has_whole_colors));
    if (has[slot_u] && has[slot_v]) {
      const vec2 uv{float(values[slot_u]), float(values[slot_v])};
      uvs_.push_back(std::isfinite(uv.x + uv.y) ? uv : vec2(0.0f));
    }
  }

  static vec3 color_of(vec3 stored, bool is_whole_number) {
    for (int c = 0; c < 3; ++c) {
      if (!std::isfinite(stored[c])) stored[c] = 0.0f;
      if (is_whole_number) stored[c] = linear_from_srgb(std::clamp(stored[c] / 255.0f, 0.0f, 1.0f));
    }
    return stored;
  }

  void read_faces(const Element& element) {
    for (std::int64_t i = 0; i < element.count && !element.properties.empty(); ++i) {
      has_faces_ = true;
      for (const Property& property : element.properties)
        if (property.name == "vertex_indices" || property.name == "vertex_index")
          read_corners(property);
        else
          skip(property);
      if (!end_face(mesh_)) ++dropped_faces_;
    }
  }

  void read_corners(const Property& property) {
    if (!property.count_type || !is_whole(property.type))
      throw InputError(name_, "'" + property.name + "' is not a list of whole numbers");
    const std::int64_t count = read_list_size(property);
    for (std::int64_t i = 0; i < count; ++i) {
      const double vertex = read_number(property.type);
      if (vertex < 0.0 || vertex >= 4294967295.0)
        throw InputError(name_, "face " + std::to_string(mesh_.face_count() + dropped_faces_) +
                                    " (from 0) names vertex " +
                                    std::to_string(std::int64_t(vertex)));
      mesh_.corners.push_back(std::uint32_t(vertex));
    }
  }

  LineReader lines_;
  std::string name_;
  Encoding encoding_ = Encoding::ascii;
  std::vector<Element> elements_;
  std::string_view body_;  ///< what is left of the file
  std::string_view line_;  ///< what is left of the line, in text
  Mesh mesh_;
  std::vector<vec2> uvs_;
  std::vector<vec3> normals_;
  bool has_faces_ = false;
  std::size_t dropped_faces_ = 0;
};

std::uint8_t srgb_byte(float linear) {
  return std::uint8_t(std::lround(255.0 * std::clamp(srgb_from_linear(double(linear)), 0.0, 1.0)));
}

}  // namespace

Mesh decode_ply(Bytes bytes, const std::string& name) { return PlyReader(bytes, name).read(); }

std::string encode_ply(const Mesh& mesh) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                      std::to_string(mesh.vertex_count()) +
                      "\nproperty float x\nproperty float y\nproperty float z\n";
  if (!mesh.vertex_colors.empty())
    bytes += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  bytes += "element face " + std::to_string(mesh.face_count()) +
           "\nproperty list uint uint vertex_indices\nend_header\n";
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    append_bytes(bytes, &mesh.positions[v], sizeof(vec3));
    for (int c = 0; c < 3 && !mesh.vertex_colors.empty(); ++c)
      bytes += char(srgb_byte(mesh.vertex_colors[v][c]));
  }
  for (std::size_t face = 0; face < mesh.face_count(); ++face) {
    const std::uint32_t begin = mesh.face_begin[face];
    const std::uint32_t count = mesh.face_begin[face + 1] - begin;
    append_bytes(bytes, &count, 4);
    append_bytes(bytes, &mesh.corners[begin], 4 * std::size_t(count));
  }
  return bytes;
}

}  // namespace parity::detail
