#pragma once

#include <vector>

#include "geometry/shadow.h"

namespace parity::cpu {

/// Share of the light that reaches each point: 1 where no cascade reaches.
///
/// Which texels hide a point is decided in single precision, as the device does; the filter is the
/// exact area of a box of 2 radius + 1 texels about the place, over texels whose depth is at least
/// that of the point less the bias. Outside of the map nothing hides.
///
/// Stable iff bias >= |slope| (radius + 1) texels (see the map shading/shadow_acne).
///
/// Source: notes 6.1; Williams 1978; Reeves et al. 1987; Zhang et al. 2006.
std::vector<double> shadow_map(const ShadowProblem& problem);

}  // namespace parity::cpu
