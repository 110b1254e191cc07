#pragma once

#include "geometry/grid.h"
#include "geometry/math.h"

namespace parity {

/// Pixels in a degree of the viewer's field, 0.7 m from a screen 0.7 m and 3840 pixels wide.
constexpr double usual_pixels_per_degree = 67.02064327658225;

/// FLIP: the difference, 0 to 1 at each pixel, that a person sees who switches between two
/// pictures on a screen. Contrast sensitivity in YCxCz, Hunt-adjusted L*a*b*, HyAB distance, edges
/// and points as features. Beyond its border a picture goes on with the border's colours.
///
/// @param reference, test  linear RGB, clamped to [0, 1]; what is no number counts as 0.
/// @param pixels_per_degree  1 to 1000.
/// @throws std::invalid_argument  sizes differ or are 0; pixels_per_degree out of range.
///
/// Source: Andersson et al. 2020, "FLIP: A Difference Evaluator for Alternating Images".
Grid<float> flip(const Grid<vec4>& reference, const Grid<vec4>& test, double pixels_per_degree);

/// The exposures at which HDR-FLIP looks at a picture, as powers of two.
struct ExposureRange {
  double start = 0.0;  ///< takes the brightest pixel to 0.85 of the screen
  double stop = 0.0;   ///< takes the median of the pixels that are not black there
  int count = 1;       ///< start and stop included; one a stop, at most 32
};

/// @param reference  linear RGB; what is not finite does not count. All black: one exposure, 0.
///
/// Source: Andersson et al. 2021, "Visualizing Errors in Rendered High Dynamic Range Images"; ACES
/// curve of Narkowicz 2015. Differs from the paper: black pixels do not enter the median, and there
/// are at most 32 exposures.
ExposureRange exposure_range(const Grid<vec4>& reference);

/// HDR-FLIP: the largest FLIP at each pixel, 0 to 1, over the exposures of the reference.
///
/// @param reference, test  linear RGB, 0 to 1e30; below counts as 0, as does what is no number.
/// @throws std::invalid_argument  as flip.
///
/// Source: Andersson et al. 2021.
Grid<float> hdr_flip(const Grid<vec4>& reference, const Grid<vec4>& test, double pixels_per_degree);

/// The mean of a map of errors; 0 for an empty one.
double mean(const Grid<float>& errors);

/// Colours of a map of values 0 to 1 by "magma", whose lightness grows evenly: black, violet, red,
/// pale yellow. Display-referred, alpha 255.
///
/// Source: van der Walt and Smith 2015; polynomial of degree 6 by Zucker 2019.
Grid<u8vec4> magma(const Grid<float>& values);

}  // namespace parity
