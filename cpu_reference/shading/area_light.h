#pragma once

#include <span>
#include <vector>

#include "geometry/math.h"
#include "shaders/shading/layout.h"

namespace parity::cpu {

/// Irradiance of rectangles of radiance 1 on surfaces: half the sum over the edges, cut at the
/// horizon, of the angle that an edge subtends times the cosine between the surface's normal and
/// that of the plane through the edge and the point.
///
/// Source: notes 6.1 (lights), 7; Lambert 1760; Baum et al. 1989.
std::vector<double> rectangle_light(std::span<const RectangleQuery> queries);

/// The same by n x n midpoints over the rectangle: cos cos / r^2 dA.
double rectangle_by_quadrature(const RectangleQuery& query, int n);

/// What rough mirrors (GGX, F = 1) show of spheres of radiance 1: the point of the sphere that is
/// nearest to the mirror direction stands for all of it; the lobe is lowered as if it were wider by
/// half the sphere's angular radius.
///
/// Accuracy: no bound; exact for small spheres. Measured: shading/sphere_light's error.
///
/// Source: Karis 2013, "Real Shading in Unreal Engine 4", area lights.
std::vector<double> sphere_light(std::span<const SphereQuery> queries);

/// The same by n x n midpoints over the sphere's solid angle.
double sphere_by_quadrature(const SphereQuery& query, int n);

}  // namespace parity::cpu
