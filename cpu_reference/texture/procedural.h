#pragma once

#include "geometry/math.h"
#include "geometry/procedural.h"

namespace parity::cpu {

/// Value of a procedural texture. The lattice repeats after 256.
///
/// @param p  coordinates below 2^30.
///
/// Source: notes 6.3; Perlin 2002, "Improving Noise"; Worley 1996; Perlin 1985.
double procedural(Procedural kind, dvec3 p);

}  // namespace parity::cpu
