#pragma once

#include "geometry/grid.h"
#include "geometry/math.h"
#include "shaders/texture/layout.h"

namespace parity::cpu {

/// The normal of a surface that is raised by a small height h along its own normal n:
/// n - grad h, where grad h is the tangent vector whose products with P_u and P_v are h_u and h_v.
/// The silhouette stays what it was.
///
/// @param detail  p_u, p_v: derivatives of the surface by u and v, not parallel; slope: h_u, h_v.
/// @return        unit.
///
/// Source: notes 6.3; Blinn 1978, "Simulation of Wrinkled Surfaces"; the terms h n_u, h n_v are
/// left out, as there.
dvec3 bump(const SurfaceDetail& detail);

/// The normal that a normal map's texel stands for, in the basis of a tangent (handedness in w),
/// the bitangent and the normal.
///
/// @param detail  normal, tangent: any length but 0, as interpolated; texel: RGB 0 to 1; scale: of
/// x
///                and y (glTF normalScale).
/// @return        unit; the normal itself for (1/2, 1/2, 1).
///
/// Source: notes 6.3; glTF 2.0, 3.9.3; Mikkelsen 2008 (MikkTSpace).
dvec3 normal_map(const SurfaceDetail& detail);

/// Where a ray meets a height field below a flat surface.
struct ParallaxHit {
  dvec2 uv{0.0};
  double depth = 0;  ///< 0 at the surface to 1 at the bottom
};

constexpr int parallax_bisections = 8;

/// Depth of a height field at a place: 1 - R / 255, bilinear, repeated.
double depth_at(const Grid<u8vec4>& heights, dvec2 uv);

/// The first of `layers` equal depths at which the ray is below the field, refined by bisection
/// between it and the one before; the bottom if there is none.
///
/// @param heights  R: 255 at the surface, 0 at the bottom.
/// @param to_eye   in the tangent space of the surface; z > 0.
/// @param scale    of the depth, texture lengths.
///
/// Source: notes 6.3; Brawley & Tatarchuk 2004, "Parallax Occlusion Mapping".
/// Accuracy: features thinner than scale |to_eye.xy| / (to_eye.z layers) may be missed.
ParallaxHit parallax(const Grid<u8vec4>& heights, dvec2 uv, dvec3 to_eye, double scale, int layers);

}  // namespace parity::cpu
