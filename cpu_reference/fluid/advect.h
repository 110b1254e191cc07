#pragma once

#include "sim/fluid.h"

namespace parity::cpu {

/// A field of cells or of the faces of one axis carried along a state's velocity for `seconds`: by
/// tracing back and linear interpolation (the problem's method is semi_lagrangian), or with the
/// error of that taken off within the values around (maccormack). 0 at points that are not active.
///
/// @param axis  0 to 2: faces; -1: cells.
/// Stable at any step: values never leave the range of the old ones.
/// Accuracy: O(h^2 / step + step^2) at a point, maccormack O(h^2 + step^2) where nothing is
/// clamped.
///
/// Source: notes 10.4; Stam 1999; Selle et al. 2008; Bridson 2015, chapter 3.
Field advect(const FluidProblem& problem, const FluidState& state, const Field& field, int axis,
             double seconds);

/// A field at a position in metres: linear between points, outside as at the border.
double sample(const FluidDomain& domain, const Field& field, int axis, dvec3 position);

}  // namespace parity::cpu
