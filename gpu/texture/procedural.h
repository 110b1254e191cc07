#pragma once

#include <span>
#include <vector>

#include "geometry/math.h"
#include "geometry/procedural.h"
#include "gpu/core/context.h"

namespace parity::gpu {

/// Values of a procedural texture. Mathematics: cpu::procedural. Accuracy: 1500 2^-24.
std::vector<float> procedural(Context& context, Procedural kind, std::span<const vec3> points);

}  // namespace parity::gpu
