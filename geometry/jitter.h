#pragma once

#include <vector>

#include "geometry/frame.h"

namespace parity {

/// The frame with everything on the screen moved by `pixels` (x right, y down).
Frame shifted(const Frame& frame, dvec2 pixels);

/// The same into a copy of the frame, whose pictures (shadow maps, environment) stay where they
/// are.
void shift_into(Frame& copy, const Frame& frame, dvec2 pixels);

}  // namespace parity
