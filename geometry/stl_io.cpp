#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <unordered_map>

#include "geometry/input_error.h"
#include "geometry/mesh_formats.h"
#include "geometry/mesh_triangulate.h"

namespace parity::detail {
namespace {

constexpr std::size_t head_bytes = 84;   // 80 of text, a count
constexpr std::size_t facet_bytes = 50;  // a normal, three corners, two bytes of attributes

static_assert(std::endian::native == std::endian::little, "STL and PLY are copied as they are");

using Key = std::array<std::uint32_t, 3>;

struct KeyHash {
  std::size_t operator()(const Key& key) const {
    std::uint64_t hash = 0;
    for (std::uint32_t bits : key) hash = (hash ^ bits) * 0x9e3779b97f4a7c15u + (hash >> 29);
    return std::size_t(hash ^ (hash >> 32));
  }
};

/// Gathers facets; corners at the same place become one vertex.
class Welder {
 public:
  void add(const std::array<vec3, 3>& facet) {
    for (const vec3& p : facet)
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
        ++dropped_;
        return;
      }
    for (const vec3& p : facet) mesh_.corners.push_back(vertex_at(p + vec3(0.0f)));  // -0 becomes 0
    end_face(mesh_);
  }

  Mesh take() {
    if (dropped_ > 0)
      mesh_.notes.push_back("facets with a coordinate that is not finite were left out: " +
                            std::to_string(dropped_) + ".");
    return std::move(mesh_);
  }

 private:
  std::uint32_t vertex_at(vec3 p) {
    const Key key{std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y),
                  std::bit_cast<std::uint32_t>(p.z)};
    const auto [entry, is_new] =
        vertex_of_key_.try_emplace(key, std::uint32_t(mesh_.positions.size()));
    if (is_new) mesh_.positions.push_back(p);
    return entry->second;
  }

  Mesh mesh_;
  std::unordered_map<Key, std::uint32_t, KeyHash> vertex_of_key_;
  std::size_t dropped_ = 0;
};

std::uint32_t claimed_facets(Bytes bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + head_bytes - 4, 4);
  return count;
}

Mesh decode_binary(Bytes bytes, const std::string& name) {
  if (bytes.size() < head_bytes)
    throw InputError(name, "is cut short: " + std::to_string(bytes.size()) +
                               " bytes, a binary STL has 84 before its facets");
  const std::size_t count = claimed_facets(bytes);
  const std::size_t room = (bytes.size() - head_bytes) / facet_bytes;
  if (count > room)
    throw InputError(name, "byte 80 claims " + std::to_string(count) +
                               " facets, but the file has room for " + std::to_string(room));
  if (count == 0) throw InputError(name, "has no facets");
  Welder welder;
  for (std::size_t f = 0; f < count; ++f) {
    std::array<vec3, 3> facet;
    std::memcpy(facet.data(), bytes.data() + head_bytes + f * facet_bytes + 12, sizeof facet);
    welder.add(facet);
  }
  return welder.take();
}

/// A coordinate may be nan or inf: the facet is then left out.
float parse_coordinate(std::string_view word, const LineReader& lines) {
  const std::string text(word.substr(0, 64));
  char* end = nullptr;
  const float value = std::strtof(text.c_str(), &end);
  if (word.empty() || end != text.c_str() + text.size())
    lines.refuse("coordinate " + quoted(word) + ", expected a number");
  return value;
}

Mesh decode_ascii(Bytes bytes, const std::string& name) {
  LineReader lines{text_of(bytes), name};
  Welder welder;
  std::array<vec3, 3> facet;
  int corner_count = 0;
  std::size_t facet_count = 0;
  for (std::string_view line; lines.next(line);) {
    const std::string_view word = take_word(line);
    if (word == "vertex") {
      if (corner_count == 3) lines.refuse("a facet with more than three corners");
      vec3& corner = facet[std::size_t(corner_count++)];
      for (int i = 0; i < 3; ++i) corner[i] = parse_coordinate(take_word(line), lines);
    } else if (word == "endloop") {
      if (corner_count != 3)
        lines.refuse("a facet with " + std::to_string(corner_count) + " corners, expected 3");
      welder.add(facet);
      corner_count = 0;
      ++facet_count;
    } else if (!word.empty() && word != "solid" && word != "endsolid" && word != "facet" &&
               word != "outer" && word != "endfacet") {
      lines.refuse(quoted(word) + ", expected facet, outer, vertex, endloop or endfacet");
    }
  }
  if (corner_count != 0) lines.refuse("the file ends inside a facet");
  if (facet_count == 0) throw InputError(name, "has no facets");
  return welder.take();
}

vec3 facet_normal(const std::array<vec3, 3>& p) {
  const dvec3 normal = glm::cross(dvec3(p[1]) - dvec3(p[0]), dvec3(p[2]) - dvec3(p[0]));
  const double length = glm::length(normal);
  return length > 0.0 ? vec3(normal / length) : vec3(0.0f);
}

}  // namespace

Mesh decode_stl(Bytes bytes, const std::string& name) {
  // Binary files may start with "solid" too; their length then gives them away.
  const bool has_binary_length =
      bytes.size() >= head_bytes &&
      bytes.size() == head_bytes + facet_bytes * std::size_t(claimed_facets(bytes));
  if (!has_binary_length && text_of(bytes).starts_with("solid")) return decode_ascii(bytes, name);
  return decode_binary(bytes, name);
}

std::string encode_stl(const Mesh& mesh) {
  const std::vector<CornerTriangle> triangles = triangulate(mesh);
  std::string bytes(head_bytes - 4, ' ');
  const auto count = std::uint32_t(triangles.size());
  append_bytes(bytes, &count, 4);
  for (const CornerTriangle& triangle : triangles) {
    std::array<vec3, 3> facet;
    for (std::size_t i = 0; i < 3; ++i) facet[i] = mesh.positions[mesh.corners[triangle[i]]];
    const vec3 normal = facet_normal(facet);
    append_bytes(bytes, &normal, 12);
    append_bytes(bytes, facet.data(), sizeof facet);
    bytes.append(2, '\0');
  }
  return bytes;
}

}  // namespace parity::detail
