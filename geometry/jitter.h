#pragma once

#include <vector>

#include "geometry/frame.h"

namespace parity {

/// The frame with everything on the screen moved by `pixels` (x right, y down).
Frame shifted(const Frame& frame, dvec2 pixels);

}  // namespace parity
