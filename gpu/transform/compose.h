#pragma once

#include <span>
#include <vector>

#include "geometry/transform.h"
#include "gpu/core/context.h"

namespace parity::gpu {

/// Translation after rotation after scale, as parent from node.
///
/// Mathematics: notes 2.1, 2.4, 2.7. Accuracy: 4 x 2^-24 of the scale.
std::vector<mat4> compose(Context& context, std::span<const Trs> transforms);

}  // namespace parity::gpu
