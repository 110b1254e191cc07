#pragma once

#include "sim/drawing.h"

namespace parity::cpu {

/// A flow in 2 dimensions as a picture: each pixel has the colour of its value, times 1 + contrast
/// s, where s in [-1, 1] is the noise along the streamline through it, the picture's streaks.
///
///   streamline  midpoint steps of direction(p) = v / (|v| + slowest) px, `streak` to either side
///   s           (mean noise - 1/2) 3/2 sqrt(streak), clamped, times |direction|; step k weighs
///               cos(pi k / (2 streak + 2))^2
///
/// Velocities and values are linear between cell centres and constant beyond the outermost.
///
/// @return  linear RGB, alpha 1; row 0 is the upper edge of the domain.
/// @throws std::invalid_argument  as check_drawn_field.
///
/// Source: Cabral & Leedom 1993, "Imaging vector fields using line integral convolution".
Grid<dvec4> draw_field(const DrawnField& field);

}  // namespace parity::cpu
