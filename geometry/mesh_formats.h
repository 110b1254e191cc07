#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/mesh.h"

/// One pair of functions a mesh format, and what text formats share; mesh_io.h chooses among them.
namespace parity::detail {

using Bytes = std::span<const std::byte>;

/// Appends bytes as they lie in memory.
inline void append_bytes(std::string& bytes, const void* from, std::size_t count) {
  bytes.append(static_cast<const char*>(from), count);
}

inline std::string_view text_of(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The lines of a text, one after the other, without their ends.
class LineReader {
 public:
  LineReader(std::string_view text, std::string name) : rest_(text), name_(std::move(name)) {}

  /// False at the end of the text.
  bool next(std::string_view& line);
  /// Of the line that `next` gave last, from 1.
  std::size_t number() const { return number_; }
  /// @throws InputError with the name and the line.
  [[noreturn]] void refuse(const std::string& what) const;
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  std::string name_;
  std::size_t number_ = 0;
};

/// Takes the next word (no blanks) off a line; empty: there is none.
std::string_view take_word(std::string_view& line);

/// What is left of a line, without the blanks around it: a name that may hold blanks.
std::string_view trimmed(std::string_view line);

/// A word in quotes for a message, cut and cleaned.
std::string quoted(std::string_view word);

/// Numbers of a line.
///
/// @throws InputError  not a number; not finite in single precision.
float parse_float(std::string_view word, const LineReader& reader);
vec3 parse_vec3(std::string_view& line, const LineReader& reader);
/// @throws InputError  not a whole number of 64 bits.
std::int64_t parse_integer(std::string_view word, const LineReader& reader);

/// Unit length, or 0 for 0.
vec3 normalized_or_zero(vec3 v);

/// @throws InputError  a corner that is no vertex. For formats that count from 0.
void check_corners(const Mesh& mesh, const std::string& name);

/// Ends the face whose corners were appended to `mesh.corners`; takes them off again if they are
/// fewer than three.
///
/// @return false: the face was left out.
bool end_face(Mesh& mesh);

/// "3 faces with fewer than three corners were left out", if there were any.
void note_dropped_faces(Mesh& mesh, std::size_t count);

/// An OBJ and the material files that it names, in order.
struct ObjFile {
  Mesh mesh;
  std::vector<std::string> material_files;
};

ObjFile decode_obj(Bytes bytes, const std::string& name);
/// Fills in the materials of `mesh` that an MTL file describes.
void apply_mtl(Mesh& mesh, Bytes bytes, const std::string& name);
Mesh decode_ply(Bytes bytes, const std::string& name);
Mesh decode_stl(Bytes bytes, const std::string& name);
Mesh decode_off(Bytes bytes, const std::string& name);

std::string encode_obj(const Mesh& mesh);
std::string encode_ply(const Mesh& mesh);
std::string encode_stl(const Mesh& mesh);
std::string encode_off(const Mesh& mesh);

}  // namespace parity::detail
