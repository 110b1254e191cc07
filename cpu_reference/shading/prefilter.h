#pragma once

#include "geometry/environment.h"

namespace parity::cpu {

/// What renderers need of an environment. Mirrors of mirror_roughness: the mean of the light that
/// `samples` half vectors (Hammersley points of the distribution, the surface looked at straight)
/// send to the eye, weighed by the cosine; each reads the map at a level whose texels are as large
/// as its share of all directions. Irradiance over pi: the sum over a level of the map.
///
/// @param samples  1 or more.
///
/// Accuracy: shading/prefilter's and shading/irradiance's error.
///
/// Source: Karis 2013; Colbert & Krivanek 2007.
EnvironmentLight prefilter(const EnvironmentMap& map, int samples);

/// One mirror without its border.
Grid<vec4> prefilter_mirror(const EnvironmentMap& map, double roughness, int side, int samples);

/// EnvironmentLight::irradiance without its border: each normal's mean of the light of all texels of
/// the finest level that has at most irradiance_source_side of them a side, weighed by the cosine to
/// their middles and by their solid angles.
Grid<vec4> prefilter_irradiance(const EnvironmentMap& map);

/// The same as coefficients of 1, y, z, x, x y, y z, 3 z^2 - 1, x z, x^2 - y^2 of the normal (x, y,
/// z): the map's projection on spherical harmonics of degree 2 times the cosine lobe's.
///
/// Accuracy: to rounding for light of degree 2; a lamp is off by up to 8 % of what it gives straight
/// on: chart shading/irradiance_models.
///
/// Source: Ramamoorthi & Hanrahan 2001.
std::array<vec3, 9> project_irradiance(const EnvironmentMap& map);

/// A mirror toward one direction, by the sum over all texels of a level.
dvec3 mirror_by_quadrature(const Grid<vec4>& level, double roughness, const dvec3& normal);

}  // namespace parity::cpu
