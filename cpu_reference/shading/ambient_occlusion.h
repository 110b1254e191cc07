#pragma once

#include "geometry/ambient_occlusion.h"

namespace parity::cpu {

/// The share of the sky, weighted by the cosine, that each place of a picture sees, 0 to 1; 1 where
/// nothing is. Surfaces are thought as thick as can be: what is behind something is hidden by it.
///
/// In each slice through the view the horizon on either side is the highest of some texels on its
/// line (how far they are, and which neighbours give the normal, is decided in single precision);
/// the integral over the slice is exact, and the sum over slices is divided by what it would be
/// were nothing hidden.
///
/// @throws std::invalid_argument  radius or slope not above 0.
///
/// Accuracy: see the chart and the map of where it fails.
/// Source: notes 6.2; Jimenez, Wu, Pesce & Jarabo 2016.
Grid<double> ambient_occlusion(const OcclusionProblem& problem);

/// Light that arrives within a slice, between both horizons: the integral of cos(t - normal) |sin t|.
///
/// @param normal   angle of the normal from the eye's direction, rad, positive ahead.
/// @param ahead    angle of the horizon from there, 0 to normal + pi / 2.
/// @param back     on the other side, 0 to pi / 2 - normal.
double open_arc(double normal, double ahead, double back);

}  // namespace parity::cpu
