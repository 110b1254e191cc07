#pragma once

#include "geometry/grid.h"
#include "geometry/math.h"
#include "geometry/tone_map.h"
#include "gpu/core/context.h"

namespace parity::gpu {

/// Linear colours as a screen can show them, in 0..1, after 2^exposure. Alpha stays.
///
/// Mathematics: cpu::tone_map.
Grid<vec4> tone_map(Context& context, const Grid<vec4>& colors, ToneMap tone_map, float exposure);

}  // namespace parity::gpu
