#pragma once

#include "geometry/grid.h"
#include "geometry/math.h"
#include "gpu/core/context.h"

namespace parity::gpu {

/// Directional albedos of rough surfaces, 16 x 16, as cpu::albedo_table: rows are roughness,
/// columns a function of the cosine; geometry/albedo_table.h says what the four numbers are.
///
/// @param samples  1 to 128 a side of the grid of sample points of each entry.
/// @throws std::invalid_argument  samples out of range.
///
/// Mathematics: cpu::albedo_table.
Grid<vec4> albedo_table(Context& context, int samples);

}  // namespace parity::gpu
