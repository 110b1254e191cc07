#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/raster.h"

namespace parity::cpu {

/// A triangle on the grid of a device, wound so that its area is positive with y down: clockwise
/// on the screen.
struct SnappedTriangle {
  std::array<ivec2, 3> corners{};  ///< in steps of the SampleGrid
  std::uint32_t triangle = 0;      ///< index in the list
  bool front = true;  ///< counter-clockwise on the screen before winding was made equal
};

/// How wide x and y may go before a triangle is clipped, in half sizes of the viewport: 32768 px,
/// so that a grid point fits 24 bits and an edge function 50.
double guard_band(int width, int height);

/// The triangles that may cover something, in the order of the list: clipped if a corner is outside
/// the depth range or the guard band or behind the eye, snapped, not of area 0, facing as
/// `list.cull` leaves them. A clipped triangle gives up to eight.
///
/// @param mirrored  the transform turned the triangles over: front and back change places.
/// @throws std::invalid_argument  as check_triangles.
///
/// Source: notes 1.1, 1.4; Vulkan 1.3, "Primitive Clipping", "Basic Polygon Rasterization".
std::vector<SnappedTriangle> set_up(const TriangleList& list, Snapping snapping, bool mirrored);

}  // namespace parity::cpu
