#pragma once

#include <array>
#include <string>

#include "geometry/grid.h"
#include "geometry/math.h"

/// The problems of the sampling chapter: filters, patterns, and signals whose spectra are known.
/// Complex numbers are 2-vectors: x real, y imaginary. Frequencies are cycles a pixel.
namespace parity {

/// Kernels of one variable, in px, even and normalised to a sum of 1 where they are used:
///   box       1 in (-1/2, 1/2), 1/2 at both ends
///   tent      1 - |x| in [-1, 1]
///   gaussian  exp(-x^2 / (2 s^2)), s = 1/2, cut at |x| = 2
///   mitchell  the cubic with B = C = 1/3, |x| <= 2
///   lanczos   sinc(x) sinc(x / 3), |x| <= 3
///
/// Source: notes 1.8; Mitchell & Netravali 1988; Duchon 1979.
enum class ReconstructionFilter { box, tent, gaussian, mitchell, lanczos };

constexpr std::array<ReconstructionFilter, 5> all_reconstruction_filters{
    ReconstructionFilter::box, ReconstructionFilter::tent, ReconstructionFilter::gaussian,
    ReconstructionFilter::mitchell, ReconstructionFilter::lanczos};

/// Beyond this a filter is 0, px.
constexpr double filter_radius(ReconstructionFilter filter) {
  constexpr std::array<double, 5> radii{0.5, 1.0, 2.0, 2.0, 3.0};
  return radii[std::size_t(filter)];
}

std::string name_of(ReconstructionFilter filter);

/// Where the samples of a pixel stand.
///   regular         middles of the cells of an a x b grid, a b = count, a >= b as equal as can be
///   random          independent, uniform
///   jittered        one at random in each cell of that grid
///   multi_jittered  one in each cell and one in each of count columns and rows; correlated
///   halton          radical inverses to bases 2 and 3
///   sobol           the first two dimensions of Sobol's sequence
///   r2              multiples of (1/g, 1/g^2), g^3 = g + 1
///   blue_noise      each the farthest of 32 random candidates from all before, on the torus
/// The seed moves halton and r2 as a whole (on the torus) and turns over digits of sobol.
enum class SamplePattern {
  regular,
  random,
  jittered,
  multi_jittered,
  halton,
  sobol,
  r2,
  blue_noise
};

constexpr std::array<SamplePattern, 8> all_sample_patterns{
    SamplePattern::regular,  SamplePattern::random,
    SamplePattern::jittered, SamplePattern::multi_jittered,
    SamplePattern::halton,   SamplePattern::sobol,
    SamplePattern::r2,       SamplePattern::blue_noise};

std::string name_of(SamplePattern pattern);

/// The cells of `count` stratified samples: columns >= rows, columns rows = count.
uvec2 strata(unsigned count);

/// 1/2 + 1/2 cos(2 pi f . p) at the middles of the pixels, p from the picture's middle.
Grid<double> grating(int width, int height, dvec2 frequency);

/// 1/2 + 1/2 cos(pi k r^2 / w) at the middles of the pixels, r from the picture's middle, w the
/// longer side: its frequency at r is k r / w along the radius, so 1/2 k at the sides.
Grid<double> zone_plate(int width, int height, double k);

/// A disc of `spokes` dark and bright sectors, turned by `angle` (counter-clockwise, rad), without
/// grey: 1 where cos(spokes (phi - angle)) > 0, outside the disc 0.
Grid<double> wheel(int side, int spokes, double angle);

/// What one step of temporal accumulation gets. Colours hold in w for how many frames they stand.
struct TemporalStep {
  Grid<vec4> current;  ///< w is not read
  Grid<vec4> history;
  Grid<vec2> motion;   ///< px: what is at p now was at p + motion in the frame before
  float longest = 16;  ///< frames that a colour may stand for, >= 1
  bool clamps = true;  ///< history is held to the range of the 3x3 neighbours of now
};

/// The part of the unit pixel [0, 1]^2 where normal . p < offset, exactly.
double half_plane_area(dvec2 normal, double offset);

}  // namespace parity
