#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/mesh.h"

namespace parity {

/// A triangle of a face: three indices into Mesh::corners, in the order of the face.
using CornerTriangle = std::array<std::uint32_t, 3>;

/// Cuts every face of n corners into n - 2 triangles, face after face, by clipping ears: concave
/// faces are not overlapped. A triangle stays what it is; a convex face becomes a fan from its
/// first corner. A face without an inside (zero area, crossing itself) is cut as far as it has
/// ears, the rest is a fan; so is what remains when 2^28 tests are spent on one mesh.
///
/// @param mesh  its corners are vertices and finite, as load_mesh gives it.
///
/// Source: Meisters 1975, "Polygons have ears"; Newell's normal: Sutherland, Sproull, Schumacker
/// 1974.
std::vector<CornerTriangle> triangulate(const Mesh& mesh);

}  // namespace parity
