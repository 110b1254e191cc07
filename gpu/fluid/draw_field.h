#pragma once

#include "gpu/core/context.h"
#include "sim/drawing.h"

namespace parity::gpu {

/// Mathematics: cpu::draw_field.
///
/// @return linear RGB, alpha 1.
/// @throws std::invalid_argument  as check_drawn_field.
Grid<vec4> draw_field(Context& context, const DrawnField& field);

}  // namespace parity::gpu
