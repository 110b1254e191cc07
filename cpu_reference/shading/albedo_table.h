#pragma once

#include "geometry/grid.h"
#include "geometry/math.h"

namespace parity::cpu {

/// Directional albedos of a rough surface: white light from everywhere comes back as
/// slope F0 + offset (GGX, one bounce, Schlick).
struct DirectionalAlbedo {
  double slope = 0;
  double offset = 0;
  double total() const { return slope + offset; }
};

/// By the distribution's own inverse: an n x n/2 grid of midpoints over its quantiles and half the
/// azimuths. At alpha 1 and cosine 1 the exact answer is 1 - ln 2.
///
/// Accuracy: O(n^-2) for cosines above alpha / n.
///
/// Source: Walter et al. 2007, 5.3; Heitz 2014.
DirectionalAlbedo directional_albedo(double alpha, double cosine, int n);

/// The part of white light from everywhere that a white Charlie sheen sends back, by Simpson's
/// rule.
///
/// Source: Estevez & Kulla 2017; KHR_materials_sheen.
double sheen_albedo(double alpha, double cosine, int n);

/// The table that shaders read, side x side: rows are roughness i / (side - 1), at least 1/64;
/// column j holds the cosine c at which (c (1 + alpha) / (c + alpha))^(1/2) = j / (side - 1), at
/// least alpha / 1000. x is slope and offset together, y how much more than c the cosine is at which
/// Schlick's (1 - cosine)^5 is offset / x, at least 0; z the root of 1 less the mean of x over the
/// cosine-weighted hemisphere. w is the albedo of a white Charlie sheen of alpha at least 0.04, at
/// the cosine (j / (side - 1))^2, at least 0.001.
///
/// @param samples  each entry is the mean over samples^2 midpoints, of the normals that the eye
///                 sees (GGX) and of the directions of light (sheen).
///
/// Source: Karis 2013 (split sum); Heitz 2018 (visible normals); Kulla & Conty 2017 (mean).
Grid<dvec4> albedo_table(int side, int samples);

}  // namespace parity::cpu
