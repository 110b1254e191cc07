#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "geometry/scene.h"

namespace parity::gltf {

/// What was mended or left out, counted, one sentence each in the end.
class Notes {
 public:
  void add(const std::string& what, std::uint64_t count = 1) {
    if (count > 0) counts_[what] += count;
  }
  /// "what: count", in alphabetical order.
  std::vector<std::string> sentences() const;

 private:
  std::map<std::string, std::uint64_t> counts_;
};

/// What a primitive's mode (0 to 6) draws.
Topology topology_of(int mode);

/// Loops, strips and fans to lists; what is left of an incomplete element is dropped.
///
/// Source: glTF 2.0, 3.7.2.1 "Overview" of meshes.
std::vector<std::uint32_t> expand(int mode, std::vector<std::uint32_t> indices, Notes& notes);

/// Vertices that the indices name, sorted; renumbers the indices to places in that list. Returns an
/// empty list, and changes nothing, if it would hold all of `vertex_count`.
std::vector<std::uint32_t> compact(std::vector<std::uint32_t>& indices, std::size_t vertex_count);

/// The elements of `values` at `which`; all if `which` is empty.
template <typename T>
std::vector<T> pick(const std::vector<T>& values, const std::vector<std::uint32_t>& which) {
  if (which.empty() || values.empty()) return values;
  std::vector<T> picked;
  picked.reserve(which.size());
  for (std::uint32_t index : which) picked.push_back(values[index]);
  return picked;
}

/// Every corner its own vertex: indices become 0, 1, 2 ...
void unshare_vertices(parity::Primitive& primitive);

/// Leaves out elements with a vertex that is not finite, and triangles without area; then the
/// vertices that nothing names.
void drop_unusable(parity::Primitive& primitive, Notes& notes);

}  // namespace parity::gltf
