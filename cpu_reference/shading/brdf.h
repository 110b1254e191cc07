#pragma once

#include <span>
#include <vector>

#include "geometry/grid.h"
#include "geometry/math.h"
#include "shaders/shading/layout.h"

namespace parity::cpu {

/// Part of unpolarised light that a border reflects; `cosine` is that between the light and the
/// border's normal, 0 to 1.
///
/// Source: notes 5.4, 6.2; Schlick 1994; Born & Wolf, "Principles of Optics", with the complex
/// index eta + i k; for k = 0 it is the Fresnel equations of dielectrics, eta >= 1 or below (total
/// reflection).
double fresnel_schlick_of(double f0, double cosine);
double fresnel_exact(double eta, double k, double cosine);

/// Density of the normals of microfacets, 1/sr, at half vector h; alpha along x and y.
///
/// Source: notes 6.2; Walter et al. 2007, in the angles of h.
/// Erratum: notes 6.2 leave open what alpha is; it is the square of the perceptual roughness.
double ggx_density(const dvec3& h, const dvec2& alpha);
double beckmann_density(const dvec3& h, const dvec2& alpha);

/// What microfacets leave visible toward both directions: 1 / (1 + Lambda(l) + Lambda(v)).
///
/// Source: Heitz 2014. Erratum: notes 6.2 name G without a formula.
double ggx_shadowing(const dvec3& l, const dvec3& v, const dvec2& alpha);
double beckmann_shadowing(const dvec3& l, const dvec3& v, const dvec2& alpha);

/// Slope, offset and mean of a table of directional albedos (geometry/albedo_table.h), and the
/// albedo of a sheen, linear between its nodes but for the mean, 1 - z^2.
///
/// @param table  of albedo_table, any side.
dvec3 albedo_at(const Grid<vec4>& table, double cosine, double roughness);
double sheen_albedo_at(const Grid<vec4>& table, double cosine, double roughness);

/// Value of a BRDF, 1/sr, by its number; 0 where a direction is not above the surface. Phong's and
/// Blinn's are those of the notes with max(0, .) and the light's irradiance taken out, or
/// multiplied by (n + 2) / 2 pi and (n + 2) (n + 4) / (8 pi (n + 2^(-n/2))), with which at most all
/// light comes back. The common (n + 8) / 8 pi for Blinn's gives 7 % too much at n = 8.
///
/// @param query   unit directions, alpha > 0, exponent >= 0.
/// @param albedo  read by brdf_ggx_multi_scatter only.
///
/// Source: notes 6.1, 6.2; Lewis 1994; Giesen 2009 ("Phong Normalization Factor Derivation"); Cook
/// & Torrance 1982; Kulla & Conty 2017; Estevez & Kulla 2017 with the visibility of Neubelt &
/// Pettineo 2013 (sheen). Erratum: notes 6.1 have no max(0, .), so that light from below subtracts,
/// and use L for radiance and direction; notes 6.2 call single scattering energy conserving, which
/// loses ln 2 of white light at alpha 1 and normal incidence.
dvec3 brdf(const BrdfQuery& query, const Grid<vec4>& albedo);
std::vector<dvec3> brdf(std::span<const BrdfQuery> queries, const Grid<vec4>& albedo);

}  // namespace parity::cpu
