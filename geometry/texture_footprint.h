#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "geometry/frame.h"

namespace parity {

/// What a pixel covers of a texture, in texels: half axes of the ellipse that the differences to
/// the next pixels make.
struct FootprintBounds {
  static constexpr double unbounded = std::numeric_limits<double>::infinity();

  double major = 0, minor = 0;  ///< at least
  double shortest = 0;          ///< each difference, at least
  double longest = unbounded;   ///< the major one, at most
  double area = unbounded;      ///< their product, at most
};

/// Where and from where triangles are shaded.
struct ShadingView {
  ShadingView(const Frame& of, bool may_move);

  const Frame& frame;
  bool moves;  ///< by up to a pixel
  dvec2 size;  ///< px
  std::vector<dvec2> samples;
  double apart = 0;  ///< m between rays a pixel apart, at w = 1, at least
};

/// A triangle, and where it may be shaded: in the pixels of which it may cover a sample if the
/// frame does not move and they are few, else anywhere in it.
struct ShadedPlaces {
  static constexpr double unbounded = std::numeric_limits<double>::infinity();

  dmat3 corners{1.0};  ///< places of the window (px) times w, and w
  std::array<dvec3, 3> world;
  std::vector<dvec2> places;  ///< px: all of it is around these, by `reach`, or between them
  double reach = 0;           ///< px, in x and in y
  double determinant = 0;     ///< of the corners
  double least = 0;           ///< 1 / w where it is shaded
  double most = unbounded;    ///< of its magnitude
  double step = unbounded;    ///< change of 1 / w to a pixel's neighbour, at most
  double slack = unbounded;   ///< relative change of gradients by moved vertices, at most
};

/// What of a triangle may be shaded, at most; no places: nothing, for it is outside, turned away,
/// or between the samples.
ShadedPlaces shaded_places(const ShadingView& view, const Draw& draw, bool double_sided,
                           const std::vector<vec3>& positions, const std::uint32_t* vertices);

/// Bounds of the footprints of its pixels.
///
/// With E the texels of the edges from corner 0 and F(p) how far a place p of the window is from
/// what they become in clip space, the derivative J of the texture over the window holds
/// J F(p) / w = E, by the quotient rule. So a sum c of edges makes J at least |E c| w / |F(p) c|,
/// which divides by no area: it holds of triangles edge-on or too thin for their gradients too. A
/// difference to the next pixel is the derivative times the ratio of w there to w here; and it is
/// no shorter than two rays a pixel apart are apart on the triangle.
///
/// @param uv  of the corners, in texels.
///
/// Source: Heckbert 1989 (derivatives of projective maps).
FootprintBounds footprint_bounds(const ShadingView& view, const ShadedPlaces& triangle,
                                 const std::array<dvec2, 3>& uv);

}  // namespace parity
