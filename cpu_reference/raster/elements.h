#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cpu_reference/raster/setup.h"
#include "cpu_reference/raster/viewport.h"
#include "geometry/frame.h"
#include "geometry/raster.h"

namespace parity::cpu {

/// One draw with its vertices in clip space.
struct PlacedDraw {
  const Draw* draw = nullptr;
  const Primitive* primitive = nullptr;
  const Material* material = nullptr;
  std::vector<vec4> clip;           ///< one a vertex
  std::uint32_t first_element = 0;  ///< of this draw, counted through all draws
  std::uint32_t element_count = 0;  ///< points, lines or triangles
};

/// Whether its fragments are dropped where alpha is below the cutoff. Lines and points never are.
bool is_masked(const PlacedDraw& draw);

/// What is rasterised: a triangle, a part of a clipped one, or half of a line's or point's
/// rectangle. `shape.triangle` is the element, counted through all draws.
struct Piece {
  SnappedTriangle shape;
  std::uint32_t draw = 0;
};

/// A scene in a frame, ready for the rasteriser.
struct Elements {
  std::vector<PlacedDraw> draws;
  SampleGrid grid;
  std::vector<Piece> opaque;   ///< opaque and masked, in the order of the scene
  std::vector<Piece> blended;  ///< far to near by the middle of each triangle
  std::uint64_t triangle_count = 0;
};

/// Runs the vertex stage, clips, snaps, culls and sorts. The scene must outlive the answer.
///
/// Lines and points are opaque whatever their material says.
///
/// @throws std::invalid_argument  more than 2^31 - 1 elements.
Elements place_elements(const Scene& scene, const Frame& frame, Snapping snapping);

/// The part of a segment in the view volume: its ends in clip space and where they lie on it.
struct ClippedLine {
  bool empty = true;
  std::array<dvec4, 2> ends{};
  std::array<double, 2> at{0.0, 1.0};  ///< 0: first vertex, 1: second; linear in clip space
};
ClippedLine clip_line(vec4 from, vec4 to);

/// Clip positions of the 1, 2 or 3 vertices of an element; the last repeats.
std::array<vec4, 3> clip_corners(const PlacedDraw& draw, std::uint32_t element);

/// Vertices of an element within its primitive; the last repeats.
std::array<std::uint32_t, 3> element_vertices(const PlacedDraw& draw, std::uint32_t element);

/// Window position in pixels of a point in clip space with w > 0.
dvec2 window_of(dvec4 clip, int width, int height);

}  // namespace parity::cpu
