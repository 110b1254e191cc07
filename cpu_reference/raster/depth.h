#pragma once

#include "geometry/camera.h"
#include "geometry/raster.h"

namespace parity::cpu {

/// What the depth buffer holds for a point `distance` m in front of the eye, 0 to 1.
///
///   standard     f / (f - n) (1 - n / z)
///   reverse_z    n / (f - n) (f / z - 1)
///   logarithmic  log2(z / n) / log2(f / n)
///
/// @param near, far  m, 0 < near < far; far may be infinite, unless logarithmic.
/// @throws std::invalid_argument  near or far outside their range.
///
/// Source: notes 1.7, 2.6.
double depth_value(DepthMode mode, double near, double far, double distance);

/// The distance in m at which the depth buffer holds `depth`: the inverse of depth_value.
double depth_distance(DepthMode mode, double near, double far, double depth);

/// How many metres one step of a D32F buffer is at a distance: the spacing of floats at the depth
/// there, divided by the slope of depth over distance.
///
/// Source: notes 1.7; Reed 2015.
/// Erratum: the notes praise reverse-Z for near-field precision. It is the far field that it mends:
/// the standard buffer crowds its codes at the near plane; reverse-Z puts far at 0, where floats
/// are densest. It needs a float buffer, near at 1, GREATER and a clear to 0.
double depth_step(DepthMode mode, double near, double far, double distance);

/// The same measured: the gap between the distances of the two floats around the depth.
double depth_step_measured(DepthMode mode, double near, double far, double distance);

/// What is in front at each pixel centre, by a D32F depth buffer: standard and logarithmic keep the
/// smaller depth (clear 1), reverse-Z the greater (clear 0); of equal depths the first drawn stays.
///
/// The depth z / w is affine in the window. Logarithmic depth is not: it is computed at each pixel
/// from the interpolated w, clamped to 0..1.
///
/// @param list  at 1 sample; clip positions made for the mode.
/// @throws std::invalid_argument  as check_triangles; samples not 1; near, far (used by logarithmic
///                                only) outside their range.
///
/// Source: notes 1.7; Vulkan 1.3, "Depth Test".
DepthImage depth_test(const TriangleList& list, DepthMode mode, double near, double far,
                      Snapping snapping);

/// How far a device's depth of one triangle a pixel may be from that of depth_test. As
/// interpolate_bound for z / w; logarithmic adds the error of log2, 3 ULP or 2^-21, over
/// log2(far / near).
///
/// @param front     1 + the triangle at each pixel; 0: none.
/// @param near_far  m.
/// @return          NaN where nothing is.
///
/// Source: conformance 1.2, 1.3.
Grid<double> depth_bound(const TriangleList& list, const Grid<std::uint32_t>& front, DepthMode mode,
                         dvec2 near_far, Snapping snapping);

}  // namespace parity::cpu
