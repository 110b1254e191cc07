#pragma once

#include <array>
#include <vector>

#include "geometry/displacement.h"

namespace parity::cpu {

constexpr int displacement_samples = 32;

/// How far a displaced edge is, in pixels, from 1, 2, 4 .. 32 straight pieces, at 32 places.
std::array<double, 6> edge_errors(const DisplacementProblem& problem, const DisplacementCorner& a,
                                  const DisplacementCorner& b);

/// Each edge in the least power of two of pieces that is within max_pixels (32 if none is); the
/// inside in the most of its edges and of the lines from corners to the middles of edges.
///
/// Source: notes 6.3; Cook 1984; Moule & McCool 2002.
std::vector<uvec4> displacement_factors(const DisplacementProblem& problem);

/// The corners of all small triangles for given factors. Lattice points on an edge of fewer parts
/// are drawn to the nearest of its points, so that neighbours meet.
std::vector<dvec3> displaced_corners(const DisplacementProblem& problem,
                                     const std::vector<uvec4>& factors);

}  // namespace parity::cpu
