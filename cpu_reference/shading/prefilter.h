#pragma once

#include "geometry/environment.h"

namespace parity::cpu {

/// What renderers need of an environment. Mirrors of roughness i / 5: the mean of the light that
/// `samples` half vectors (Hammersley points of the distribution, the surface looked at straight)
/// send to the eye, weighed by the cosine; each reads the map at a level whose texels are as large
/// as its share of all directions. Irradiance over pi: the map's projection on spherical harmonics
/// of degree 2 times the cosine lobe's.
///
/// @param samples  1 or more.
///
/// Accuracy: irradiance within 3 % of the mean for any light (Ramamoorthi & Hanrahan), to rounding
/// for light of degree 2; mirrors: shading/prefilter's error.
///
/// Source: Karis 2013; Colbert & Krivanek 2007; Ramamoorthi & Hanrahan 2001.
EnvironmentLight prefilter(const EnvironmentMap& map, int samples);

/// One mirror without its border.
Grid<vec4> prefilter_mirror(const EnvironmentMap& map, double roughness, int side, int samples);

/// EnvironmentLight::irradiance alone.
std::array<vec3, 9> project_irradiance(const EnvironmentMap& map);

/// A mirror toward one direction, by the sum over all texels of a level.
dvec3 mirror_by_quadrature(const Grid<vec4>& level, double roughness, const dvec3& normal);

}  // namespace parity::cpu
