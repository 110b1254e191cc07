#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "geometry/input_error.h"
#include "geometry/mesh_formats.h"

namespace parity::detail {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\r'; }

}  // namespace

bool LineReader::next(std::string_view& line) {
  if (rest_.empty()) return false;
  const std::size_t end = std::min(rest_.find('\n'), rest_.size());
  line = rest_.substr(0, end);
  if (line.ends_with('\r')) line.remove_suffix(1);
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  ++number_;
  return true;
}

void LineReader::refuse(const std::string& what) const { throw InputError(name_, number_, what); }

std::string_view take_word(std::string_view& line) {
  std::size_t begin = 0;
  while (begin < line.size() && is_blank(line[begin])) ++begin;
  std::size_t end = begin;
  while (end < line.size() && !is_blank(line[end])) ++end;
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

std::string_view trimmed(std::string_view line) {
  while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
  while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
  return line;
}

std::string quoted(std::string_view word) {
  std::string text = "'";
  for (char c : word.substr(0, 40)) text += c >= 32 && c < 127 ? c : '?';
  return text + (word.size() > 40 ? "...'" : "'");
}

float parse_float(std::string_view word, const LineReader& reader) {
  std::string_view digits = word;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  float value = 0.0f;
  auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range)  // too small becomes 0, too large infinity
    value = std::strtof(std::string(digits).c_str(), nullptr);
  else if (error != std::errc{})
    end = digits.data();
  if (digits.empty() || end != digits.data() + digits.size())
    reader.refuse(word.empty() ? "a number is missing" : quoted(word) + ", expected a number");
  if (!std::isfinite(value))
    reader.refuse(quoted(word) + ", expected a number that is finite in single precision");
  return value;
}

vec3 parse_vec3(std::string_view& line, const LineReader& reader) {
  vec3 v;
  for (int i = 0; i < 3; ++i) v[i] = parse_float(take_word(line), reader);
  return v;
}

std::int64_t parse_integer(std::string_view word, const LineReader& reader) {
  std::string_view digits = word;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size())
    reader.refuse(word.empty() ? "a whole number is missing"
                               : quoted(word) + ", expected a whole number");
  return value;
}

vec3 normalized_or_zero(vec3 v) {
  const dvec3 d{v};
  const double length = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
  return length > 0.0 ? vec3(d / length) : vec3(0.0f);
}

void check_corners(const Mesh& mesh, const std::string& name) {
  for (std::size_t face = 0; face < mesh.face_count(); ++face)
    for (std::size_t c = mesh.face_begin[face]; c < mesh.face_begin[face + 1]; ++c)
      if (mesh.corners[c] >= mesh.vertex_count())
        throw InputError(name, "face " + std::to_string(face) + " (from 0) names vertex " +
                                   std::to_string(mesh.corners[c]) + ", expected below " +
                                   std::to_string(mesh.vertex_count()));
}

bool end_face(Mesh& mesh) {
  const std::uint32_t begin = mesh.face_begin.back();
  if (mesh.corners.size() - begin < 3) {
    mesh.corners.resize(begin);
    return false;
  }
  mesh.face_begin.push_back(std::uint32_t(mesh.corners.size()));
  return true;
}

void note_dropped_faces(Mesh& mesh, std::size_t count) {
  if (count > 0)
    mesh.notes.push_back(
        "faces with fewer than three corners were left out: " + std::to_string(count) + ".");
}

}  // namespace parity::detail
