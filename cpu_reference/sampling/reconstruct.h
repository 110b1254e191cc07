#pragma once

#include "geometry/grid.h"
#include "geometry/math.h"
#include "geometry/sampling.h"

namespace parity::cpu {

/// A filter at x px from its middle, with integral 1 (gaussian: but for what is cut off).
double filter_value(ReconstructionFilter filter, double x);

/// Its Fourier transform at f cycles a pixel, in closed form:
///   box sinc(f); tent sinc(f)^2; gaussian exp(-2 pi^2 s^2 f^2), which neglects what is cut off
///   (6.4e-5 at most); mitchell by the jumps of its second and third derivatives; lanczos by the
///   sine integral.
double filter_spectrum(ReconstructionFilter filter, double f);

/// The picture at another size. A pixel is the mean of the source under the filter, which is as
/// wide as a pixel of the coarser of the two grids; beyond its border the source goes on with its
/// last texels. Weights sum to 1 in each pixel.
///
/// @param picture  linear in what is to be averaged.
/// @throws std::invalid_argument  an empty picture, or a side of the size outside 1..16384.
///
/// Source: notes 1.8. Erratum: notes 1.8 say of box, linear and Gaussian filters that they trade
/// blur against ringing; these never ring. Filters with negative lobes do (Mitchell, Lanczos).
Grid<dvec4> reconstruct(const Grid<dvec4>& picture, ivec2 size, ReconstructionFilter filter);

}  // namespace parity::cpu
