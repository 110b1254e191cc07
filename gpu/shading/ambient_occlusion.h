#pragma once

#include "geometry/ambient_occlusion.h"
#include "gpu/core/context.h"

namespace parity::gpu {

/// @throws std::invalid_argument  as cpu::ambient_occlusion.
///
/// Mathematics: cpu::ambient_occlusion.
Grid<float> ambient_occlusion(Context& context, const OcclusionProblem& problem);

}  // namespace parity::gpu
