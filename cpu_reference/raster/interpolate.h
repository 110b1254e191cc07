#pragma once

#include <array>

#include "geometry/raster.h"

namespace parity::cpu {

/// An affine function of the window position in px.
struct WindowPlane {
  double at_origin = 0.0;
  double dx = 0.0;
  double dy = 0.0;

  double at(double x, double y) const { return at_origin + dx * x + dy * y; }
};

/// What a triangle is in the window: b_i / w for its barycentric coordinates b, 1 / w and the depth
/// z / w. All are affine there, for every triangle, in front of the eye or across it, so clipped
/// pieces need nothing of their own.
struct TrianglePlanes {
  std::array<WindowPlane, 3> barycentric_over_w;
  WindowPlane reciprocal_w;
  WindowPlane depth;

  /// Barycentric coordinates of the point of the triangle that is seen at a window position.
  dvec3 perspective(double x, double y) const {
    const dvec3 b{barycentric_over_w[0].at(x, y), barycentric_over_w[1].at(x, y),
                  barycentric_over_w[2].at(x, y)};
    return b / (b.x + b.y + b.z);
  }
};

/// The planes from unsnapped clip positions: the inverse of the matrix with columns (x, y, w), at
/// (X, Y, 1). A triangle without area gets the mean of its corners everywhere.
///
/// Source: notes 1.6; Olano & Greer 1997 ("Triangle scan conversion using 2D homogeneous
/// coordinates").
/// Erratum: notes 1.3 interpolate depth "after perspective correction"; the depth buffer's z / w is
/// affine in the window, and correcting it would be wrong. Notes 1.6 call what is divided by
/// "screen depth z"; it is clip w.
TrianglePlanes triangle_planes(const std::array<vec4, 3>& clip, int width, int height);

/// The varying at the centre of each pixel, of the last triangle that covers the centre;
/// perspective-correct, or affine in the window.
///
/// @param list       at 1 sample.
/// @param varyings   one value a clip position.
/// @return           width x height values; NaN where nothing is.
/// @throws std::invalid_argument  as check_triangles; samples not 1; wrong number of values.
///
/// Source: notes 1.6; Vulkan 1.3, "Basic Polygon Rasterization".
Grid<dvec4> interpolate(const TriangleList& list, const Varyings& varyings, Snapping snapping);

/// How far a device may be from `interpolate`, the largest of the four components; NaN where
/// nothing is. For an affine function a = a0 + a_x x + a_y y over the window (the varying itself,
/// or a / w and 1 / w)
///   e = sqrt2 2^-(b+1) |grad a|                 a vertex may move by half a grid step, b its bits
///     + 8 2^-24 max(|a0| + |a_x| W + |a_y| H, |a_i|)   float evaluation from the origin
///     + 4 2^-24 max|a_i| L^2 / 2A               float set-up; L the longest edge, A the area
/// and for the perspective quotient q = n / d: (e_n + |q| e_d) / (|d| - e_d) + 11 2^-23 |q|.
///
/// Source: conformance 1.3, "varyings, z"; its bound leaves out the third term, which counts for
/// slivers only: the gradient is a sum of products of float differences, divided by twice the area.
Grid<double> interpolate_bound(const TriangleList& list, const Varyings& varyings,
                               Snapping snapping);

}  // namespace parity::cpu
