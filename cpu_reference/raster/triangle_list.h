#pragma once

#include <array>

#include "geometry/raster.h"

namespace parity::cpu {

/// @throws std::invalid_argument  a side outside 0..16384, samples not 1, 2, 4 or 8, or a triangle
///                                with an index out of range.
void check_triangles(const TriangleList& list);

/// The clip positions of one triangle of a checked list.
std::array<vec4, 3> corners_of(const TriangleList& list, std::uint32_t triangle);

}  // namespace parity::cpu
